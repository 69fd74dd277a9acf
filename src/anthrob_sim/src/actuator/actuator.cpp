#include "anthrob_sim/actuator/actuator.h"

#include <map>

#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/actuator/hill_muscle.h"
#include "anthrob_sim/actuator/ligament.h"

namespace anthrob {

std::shared_ptr<const Actuator> make_actuator(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step) {
  using Factory = std::shared_ptr<const Actuator> (*)(const ConfigNode&, const ConfigNode&, double);
  // A new actuator: one file, one line here.
  static const std::map<std::string, Factory> kFactories = {
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
  return it->second(kind, muscle, step);
}

}  // namespace anthrob
