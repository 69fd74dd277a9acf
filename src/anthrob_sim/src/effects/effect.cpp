#include "anthrob_sim/effects/effect.h"

#include <algorithm>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {

std::string seam_name(Seam seam) {
  static const char* const kNames[] = {"controller", "power stage", "motor",  "gear",
                                       "spindle",    "tendon",      "spring", "path",
                                       "skeleton",   "joints",      "sensors"};
  return kNames[static_cast<int>(seam)];
}

const EffectParameter* EffectInfo::find(const std::string& parameter) const {
  for (const EffectParameter& p : parameters) {
    if (p.name == parameter) return &p;
  }
  return nullptr;
}

std::vector<EffectParameter> Effect::parameters_at(const RobotModel&, const std::string&) const {
  return info_.parameters;
}

EffectSetting::EffectSetting(const Effect& effect, EffectInstance instance,
                             std::vector<EffectParameter> parameters, const ConfigNode& origin)
    : effect_(&effect),
      instance_(std::move(instance)),
      parameters_(std::move(parameters)),
      origin_(origin) {
  bool any_size = false;
  for (const EffectParameter& p : parameters_) {
    const auto given = instance_.parameters.find(p.name);
    values_.push_back(given == instance_.parameters.end() ? p.neutral : given->second);
    if (given == instance_.parameters.end()) continue;
    any_size = any_size || p.kind == EffectParameter::kSize;
    if (!p.bounds.contains(given->second)) {
      fail(p.name, p.bounds.text() + " [" + p.unit + "]");
    }
  }
  std::string names, sizes;
  for (const EffectParameter& p : parameters_) {
    names += (names.empty() ? "" : ", ") + p.name;
    if (p.kind == EffectParameter::kSize) sizes += (sizes.empty() ? "" : ", ") + p.name;
  }
  for (const auto& [name, value] : instance_.parameters) {
    const bool known = std::any_of(parameters_.begin(), parameters_.end(),
                                   [&](const EffectParameter& p) { return p.name == name; });
    if (!known) fail(name, "one of the effect's parameters there: " + names);
  }
  if (!any_size)
    fail("place", "at least one size of the effect in the same entry; sizes: " + sizes);
}

bool EffectSetting::neutral() const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i].kind == EffectParameter::kSize && values_[i] != parameters_[i].neutral) {
      return false;
    }
  }
  return true;
}

double EffectSetting::operator[](const std::string& parameter) const {
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    if (parameters_[i].name == parameter) return values_[i];
  }
  throw BadInput("effect " + id() + ": it has no parameter '" + parameter + "'");
}

void EffectSetting::fail(const std::string& key, const std::string& expectation) const {
  if (origin_.is_map() && origin_.has("id") && origin_.has(key)) {
    origin_.at(key).fail_expected(expectation);
  }
  const auto given = instance_.parameters.find(key);
  const std::string value =
      given == instance_.parameters.end() ? "" : significant(given->second, 12);
  origin_.fail("effect " + id() + " at " + place() + ": " +
               (key == "place" ? "" : key + ": " + value + ": ") + "expected " + expectation);
}

}  // namespace anthrob
