#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>

#include "anthrob_core/random.h"
#include "axis_rows.h"
#include "discover.h"

namespace anthrob {
namespace discovery {

/// A hinge on a bench, by its closed equation: it turns to and fro along a given curve, with a
/// pause at every end, and the effort is what that takes. No simulator is involved.
struct DrivenBench {
  double inertia = 1e-3;              ///< [kg m^2]
  double viscous = 1e-3;              ///< [Nms/rad]
  double coulomb = 0.0;               ///< [Nm]
  double offset = 0.0;                ///< [Nm] that pushes forward
  double gravity = 0.0;               ///< [Nm] m g l: pulls to 0
  double rate = 500.0;                ///< [Hz] of rows
  int bits = 16;                      ///< of the encoder, per turn
  double noise = 1e-3;                ///< [Nm] of the effort
  double longest = 1.5, pause = 0.3;  ///< [s] of a move; after it
  double seconds = 20.0;

  struct Point {
    double q, v, a;
  };

  Dataset record(std::uint64_t seed) const {
    AxisRows made("bench_" + std::to_string(seed), "bench");
    const CounterRandom random(seed, 31);
    const auto rows = static_cast<std::size_t>(seconds * rate);
    const double count = 2.0 * M_PI / std::pow(2.0, bits);
    Curve curve{random, *this};
    for (std::size_t i = 0; i < rows; ++i) {
      const double t = static_cast<double>(i) / rate;
      const double position = std::round(curve.at(t).q / count) * count;
      // Held until the next row, as a drive holds it.
      constexpr int kPoints = 10;
      double mean = 0.0;
      for (int k = 0; k < kPoints; ++k) {
        mean += needed(curve.at(t + (k + 0.5) / kPoints / rate), random, curve) / kPoints;
      }
      made.add(t, position, mean + noise * random.normal(1000 + i));
    }
    return made.data();
  }

  /// The robot as its user knows it: without dry friction and offset.
  /// @param factor of the inertia that the model states
  std::string model(double factor = 1.0) const {
    static int count = 0;
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() /
        ("bench_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder);
    // A rod of that inertia about its hinge; weight as gravity says.
    const double arm = gravity > 0.0 ? 0.1 : 0.0;
    const double mass = gravity > 0.0 ? gravity / 9.81 / arm : 1.0;
    const double own = std::max(1e-12, factor * inertia - mass * arm * arm);
    std::ofstream urdf(folder / "robot.urdf");
    urdf << std::setprecision(12)
         << R"(<robot name="bench"><link name="base"/><joint name="axis" type="continuous">)"
         << R"(<parent link="base"/><child link="rotor"/><axis xyz="0 1 0"/></joint>)"
         << R"(<link name="rotor"><inertial><origin xyz="0 0 )" << -arm << R"("/><mass value=")"
         << mass << R"("/><inertia ixx=")" << own << R"(" iyy=")" << own << R"(" izz=")" << own
         << R"(" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>)";
    std::ofstream model(folder / "model.yaml");
    model << std::setprecision(12) << "robot: robot.urdf\ngravity: [0, 0, "
          << (gravity > 0.0 ? -9.81 : 0.0) << "]\njoints:\n  axis: {driven: true, friction: "
          << "{static: 0.0, kinetic: 0.0, viscous: " << viscous << ", stribeck_velocity: 0.05}}\n";
    std::ofstream(folder / "calibration.yaml")
        << std::setprecision(12) << "parameters:\n  - {path: joints.axis.friction.viscous, unit: "
        << "Nms/rad, low: 0.0, high: " << 10.0 * viscous << ", step: " << 0.2 * viscous << "}\n";
    return (folder / "model.yaml").string();
  }

  Question question(double factor = 1.0) const {
    Question question;
    question.model_file = model(factor);
    question.nuisances = ordinary_parameters(question.model_file);
    question.train = {record(1)};
    question.test = {record(2)};
    return question;
  }

 private:
  /// Moves of different lengths and heights, each smooth up to the acceleration.
  struct Curve {
    const CounterRandom& random;
    const DrivenBench& bench;
    std::uint64_t index = 0;
    double begin = 0.0, length = 0.5, from = 0.0, height = 0.0;

    Point at(double t) {
      while (t > begin + length + bench.pause) {
        begin += length + bench.pause;
        from += height;
        length = bench.longest * (0.4 + 0.6 * random.uniform(2 * index));
        height = (0.3 + 1.2 * random.uniform(2 * index + 1)) * (from > 0.0 ? -1.0 : 1.0);
        ++index;
      }
      const double s = std::clamp((t - begin) / length, 0.0, 1.0);
      return {from + height * s * s * s * (10.0 + s * (6.0 * s - 15.0)),
              height / length * 30.0 * s * s * (1.0 - s) * (1.0 - s),
              height / length / length * 60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)};
    }
  };

  double needed(const Point& at, const CounterRandom& random, const Curve& curve) const {
    // At rest, any effort that friction holds.
    const double held = coulomb * (2.0 * random.uniform(500 + curve.index) - 1.0);
    const double friction = at.v == 0.0 ? held : std::copysign(coulomb, at.v);
    return inertia * at.a + viscous * at.v + friction - offset + gravity * std::sin(at.q);
  }
};

}  // namespace discovery
}  // namespace anthrob
