#include "diagnostics.h"

#include <algorithm>

namespace anthrob {

std::optional<std::string> Diagnosis::value(const std::string& key) const {
  for (const auto& [own_key, text] : values) {
    if (own_key == key) return text;
  }
  return std::nullopt;
}

bool Diagnosis::names(const std::string& muscle) const {
  return std::any_of(values.begin(), values.end(),
                     [&](const auto& entry) { return entry.first.rfind(muscle + " ", 0) == 0; });
}

void Diagnostics::hear(const Diagnosis& diagnosis, double now) {
  const auto same = std::find_if(last_.begin(), last_.end(), [&](const Heard& heard) {
    return heard.diagnosis.name == diagnosis.name;
  });
  if (same == last_.end()) {
    last_.push_back({diagnosis, now});
  } else {
    *same = {diagnosis, now};
  }
}

std::vector<Diagnosis> Diagnostics::all(double now) const {
  std::vector<Diagnosis> diagnoses;
  for (const Heard& heard : last_) {
    diagnoses.push_back(heard.diagnosis);
    if (now - heard.time > kStale) diagnoses.back().level = Level::kStale;
  }
  return diagnoses;
}

std::optional<Diagnosis> Diagnostics::of(const std::string& robot, const std::string& part,
                                         double now) const {
  for (const Diagnosis& diagnosis : all(now)) {
    const bool wanted = diagnosis.name == robot + ": " + part;
    if (wanted && diagnosis.level != Level::kStale) return diagnosis;
  }
  return std::nullopt;
}

std::optional<Diagnosis> Diagnostics::unit_of_muscle(const std::string& robot,
                                                     const std::string& muscle, double now) const {
  for (const Diagnosis& diagnosis : all(now)) {
    if (whole_and_part(diagnosis.name).first != robot) continue;
    if (diagnosis.names(muscle)) return diagnosis;
  }
  return std::nullopt;
}

std::pair<std::string, std::string> whole_and_part(const std::string& name) {
  const std::size_t colon = name.find(": ");
  if (colon == std::string::npos) return {std::string(), name};
  return {name.substr(0, colon), name.substr(colon + 2)};
}

}  // namespace anthrob
