#include "measurement/expected_current.h"

#include "anthrob_sim/actuator/dc_motor.h"

namespace anthrob {
namespace discovery {

Series expected_current(const MuscleModel& muscle, const Dataset& recording, double beside) {
  Series expected;
  const auto* motor = dynamic_cast<const DcMotor*>(muscle.actuator.get());
  if (motor == nullptr) return expected;
  const auto& p = motor->parameters();
  const Series voltage = recording.series(muscle.name + "/voltage"),
               position = recording.series(muscle.name + "/position");
  if (voltage.empty() || position.empty()) return expected;
  const double length = position.t.back() - position.t.front();
  if (length > 2.0 * beside * static_cast<double>(position.t.size())) return expected;
  for (std::size_t i = 0; i < voltage.t.size(); ++i) {
    const double t = voltage.t[i];
    if (t - beside < position.t.front() || t + beside > position.t.back()) continue;
    const double velocity = (position.at(t + beside) - position.at(t - beside)) / (2.0 * beside);
    expected.t.push_back(t);
    expected.values.push_back((voltage.values[i] - p.back_emf_constant * p.ratio * velocity) /
                              p.resistance);
  }
  return expected;
}

}  // namespace discovery
}  // namespace anthrob
