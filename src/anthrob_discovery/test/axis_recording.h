#pragma once

#include <cmath>
#include <cstdint>

#include "anthrob_core/random.h"
#include "axis_rows.h"
#include "discover.h"

namespace anthrob {
namespace discovery {

/// m a = u - viscous v - coulomb sign(v) - offset - stiffness (q - 0.1 m), under a slowly reversing
/// effort, integrated with steps of 10 us.
inline Dataset axis_recording(double coulomb, double offset, std::uint64_t seed,
                              double viscous = 203.5, double stiffness = 0.0) {
  AxisRows made("axis", "driven_axis");
  const CounterRandom random(seed, 9);
  const double mass = 95.1089, h = 1e-5;
  const double first = 60.0 + 20.0 * random.uniform(1), second = 2.0 + 3.0 * random.uniform(2);
  double q = 0.1, v = 0.0, u = 0.0;  // far from both stops
  for (int i = 0; i < 800000; ++i) {
    // Held over a millisecond, as a recording's effort is; a spring keeps the carriage in place.
    const int row = i / 100;
    const double now = 1e-3 * row;
    if (i % 100 == 0)
      u = first * std::sin(1.7 * now) + 0.5 * first * std::sin(second * now) - 2000.0 * (q - 0.1);
    if (i % 100 == 0) {
      made.add(now, q + 2e-7 * random.normal(static_cast<std::uint64_t>(100 + row)), u);
    }
    const double drive = u - offset - stiffness * (q - 0.1) - viscous * v;
    const double friction = std::abs(v) < 1e-7 && std::abs(drive) < coulomb
                                ? drive
                                : std::copysign(coulomb, v == 0.0 ? drive : v);
    const double next = v + h / mass * (drive - friction);
    v = v != 0.0 && next * v < 0.0 && std::abs(drive) < coulomb ? 0.0 : next;
    q += h * v;
  }
  return made.data();
}

inline Question axis_question(double coulomb, double offset) {
  Question question;
  question.model_file = ANTHROB_CONFIG_DIR "/driven_axis/model_I.yaml";
  question.nuisances = ordinary_parameters(question.model_file);
  question.train = {axis_recording(coulomb, offset, 1)};
  question.test = {axis_recording(coulomb, offset, 2)};
  return question;
}

}  // namespace discovery
}  // namespace anthrob
