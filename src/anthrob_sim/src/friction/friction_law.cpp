#include "anthrob_sim/friction/friction_law.h"

#include <map>

#include "friction/smooth_stribeck.h"
#include "friction/sticking.h"

namespace anthrob {

std::shared_ptr<const FrictionLaw> make_friction_law(const ConfigNode& node, double step) {
  using Factory = std::shared_ptr<const FrictionLaw> (*)(const ConfigNode&, double);
  // A new law: one file, one line here.
  static const std::map<std::string, Factory> kFactories = {
      {"none", [](const ConfigNode&, double) { return std::shared_ptr<const FrictionLaw>(); }},
      {"smooth_stribeck", &SmoothStribeck::load},
      {"sticking", &Sticking::load},
  };
  const auto it = kFactories.find(node.text("law"));
  if (it == kFactories.end()) {
    std::string known;
    for (const auto& entry : kFactories) known += (known.empty() ? "" : ", ") + entry.first;
    node.at("law").fail_expected("one of: " + known);
  }
  return it->second(node, step);
}

}  // namespace anthrob
