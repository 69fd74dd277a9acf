#include "anthrob_sim/actuator/actuator.h"

#include <map>

#include "actuator/hill_muscle.h"
#include "actuator/ligament.h"
#include "anthrob_sim/actuator/dc_motor.h"

namespace anthrob {

namespace {

using ActuatorFactory = std::shared_ptr<const Actuator> (*)(const ConfigNode&, const ConfigNode&,
                                                            double);

ActuatorFactory factory_of(const ConfigNode& kind) {
  // A new actuator: one file, one line here.
  static const std::map<std::string, ActuatorFactory> kFactories = {
      {"dc_motor", &DcMotor::load},
      {"hill", &HillMuscle::load},
      {"ligament", &Ligament::load},
  };
  const auto it = kFactories.find(kind.text("type"));
  if (it == kFactories.end()) {
    std::string known;
    for (const auto& entry : kFactories) known += (known.empty() ? "" : ", ") + entry.first;
    kind.at("type").fail_expected("one of: " + known);
  }
  return it->second;
}

}  // namespace

std::shared_ptr<const Actuator> make_actuator(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step) {
  return factory_of(kind)(kind, muscle, step);
}

std::shared_ptr<const Actuator> make_drive_motor(const ConfigNode& kind, double ratio,
                                                 double step) {
  if (kind.text("type") != "dc_motor") {
    kind.at("type").fail_expected("dc_motor: only a motor drives a joint");
  }
  return DcMotor::build(kind, 1.0 / ratio, 0.0, step);
}

double read_rest_tendon_length(const ConfigNode& muscle) {
  return muscle.number("rest_tendon_length", {0.0, 10.0, true, false}, "m");
}

void require_actuator_type(const ConfigNode& kind) {
  factory_of(kind);
}

}  // namespace anthrob
