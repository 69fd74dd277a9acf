#include "virtual_rig/eyelet_pull.h"

#include <cmath>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/simulation.h"
#include "virtual_rig/virtual_recording.h"

namespace anthrob {
namespace virtual_rig {

namespace {

constexpr double kStep = 0.001;               // [s]
constexpr double kStanding = 1.0;             // [s] before and after the motion
constexpr double kPull = 3.2, kRelax = -2.2;  // [V] about 25 mm/s either way
constexpr double kStaticRatio = 0.8;          // mu_k / mu_s, as in the thesis
constexpr double kGrain = 0.003;              // [m] length over which the line is alike
constexpr double kPath = 0.9, kSpindleToEyelet = 0.4, kLineRest = 0.01;  // [m]
constexpr double kLineStiffness = 20000.0;  // [N/m] as in the model file
constexpr double kHalfPi = 0.5 * M_PI;

/// Friction that changes as the line passes by: a first-order random walk along its length.
class UnevenLine {
 public:
  UnevenLine(double size, std::uint64_t seed, std::uint64_t stream)
      : noise_(seed, stream), size_(size), value_(noise_.next(size)) {}
  double advance(double distance) {
    const double keep = std::exp(-std::abs(distance) / kGrain);
    value_ = keep * value_ + noise_.next(size_) * std::sqrt(1.0 - keep * keep);
    return value_;
  }

 private:
  Deviations noise_;
  double size_, value_;
};

}  // namespace

std::vector<double> thesis_loads() {
  return {21.2, 36.4, 51.9, 67.5};
}

Dataset pull_over_eyelet(const std::string& rig, const PullOptions& options) {
  Deviations of_rig(options.seed, 0);
  Deviations of_eyelet(options.seed, static_cast<std::uint64_t>(options.specimen));
  const double offset = of_rig.next(options.force_offset_sigma);
  const double tilt = of_rig.next(options.turning_sigma);
  const double batch = 1.0 + of_eyelet.next(options.batch_sigma);
  const double friction = options.friction * (options.specimen > 1 ? batch : 1.0);
  const auto recording = static_cast<std::uint64_t>(
      1000 * options.specimen + 2 * std::lround(options.load) + (options.pulling ? 1 : 0));

  LoadOptions load;
  load.step = kStep;
  load.overrides["eyelet_friction.kinetic"] = friction;
  load.overrides["eyelet_friction.static"] = friction / kStaticRatio;
  load.overrides["muscles.tendon.path.0.point.2"] = 1.0 + kSpindleToEyelet * std::tan(tilt);
  const double path = kPath + kSpindleToEyelet * (1.0 / std::cos(tilt) - 1.0);
  load.overrides["muscles.tendon.rest_tendon_length"] =
      path - kLineRest - options.load / kLineStiffness;
  load.overrides["sensors.seed"] =
      static_cast<double>((options.seed * 1009 + recording) % 2147483647);
  const auto model = load_robot_model(rig + "/model_I.yaml", load);
  Simulation sim(model);
  sim.apply_load(0, options.load);

  Dataset data;
  data.meta.robot = "rig_eyelet_pull";
  data.meta.kind = "rig";
  data.meta.rate = 1.0 / kStep;
  data.meta.other["specimen"] = "{number: " + std::to_string(options.specimen) + "}\n";
  data.meta.other["rig"] = "{turning: " + exact_text(kHalfPi) +
                           ", turning_sigma: " + exact_text(options.turning_sigma) + "}\n";
  data.meta.other["notes"] =
      "simulated by anthrob_virtual_rig, seed " + std::to_string(options.seed) + "\n";
  RowWriter rows(data.table("rig"), {"tendon/mode", "tendon/reference", "tendon/position",
                                     "tendon/voltage", "tendon/force", "weight/load"});

  UnevenLine line(options.unevenness, options.seed, 1000000 + recording);
  const auto run = [&](ecu::Mode mode, double reference, double duration) {
    sim.command(0, mode, reference);
    for (auto steps = std::lround(duration / kStep); steps > 0; --steps) {
      const Muscle& tendon = sim.muscle(0);
      const double speed = sim.tree().velocities()[0];
      const double uneven = line.advance(speed * kStep) * kHalfPi;
      // The share grows with the speed like the friction itself: nothing at rest.
      const double rubbing = -std::tanh(speed / 0.001) * uneven * tendon.force();
      rows.add(sim.time(),
               {static_cast<double>(mode), reference, tendon.measured().position, tendon.voltage(),
                tendon.measured().force + rubbing + offset, options.load});
      sim.step();
    }
  };
  run(ecu::Mode::kPosition, 0.0, kStanding);
  run(ecu::Mode::kVoltage, options.pulling ? kPull : kRelax, options.duration);
  run(ecu::Mode::kPosition, sim.muscle(0).measured().position, kStanding);
  return data;
}

}  // namespace virtual_rig
}  // namespace anthrob
