#include "health/findings.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "anthrob_core/text.h"

namespace anthrob {
namespace health {

namespace {

using Trends = std::map<Quantity, Trend>;

/// -1 fallen, +1 risen, 0 as it was.
int direction(const Trends& trends, Quantity quantity) {
  const auto found = trends.find(quantity);
  if (found == trends.end() || !found->second.is_certain) return 0;
  return found->second.change() > 0.0 ? 1 : -1;
}

double logarithm_of_change(const Trends& trends, Quantity quantity) {
  const auto found = trends.find(quantity);
  return found == trends.end() ? 0.0 : std::log(found->second.now / found->second.normal);
}

/// Of a force sensor's gain: what is a force per something rises as the other way round falls.
bool is_sensor_gain(const Trends& trends) {
  const double stiffer = logarithm_of_change(trends, Quantity::kStiffness),
               pull = logarithm_of_change(trends, Quantity::kCurrentGain);
  return direction(trends, Quantity::kStiffness) != 0 &&
         direction(trends, Quantity::kCurrentGain) != 0 &&
         std::abs(stiffer + pull) < 0.5 * std::max(std::abs(stiffer), std::abs(pull));
}

struct Cause {
  std::string words;
  std::vector<Quantity> quantities;  ///< that it changes
  std::function<bool(const Trends&)> shows;
};

bool has(const Trends& trends, Quantity quantity, int sign) {
  return direction(trends, quantity) == sign;
}

/// The first that shows explains its quantities.
const std::vector<Cause>& causes() {
  using Q = Quantity;
  static const std::vector<Cause> all = {
      {"its force sensor's gain has changed",
       {Q::kStiffness, Q::kCurrentGain, Q::kHysteresis, Q::kZero},
       is_sensor_gain},
      {"it frays, or its spring tears",
       {Q::kStiffness, Q::kCreep, Q::kZero, Q::kHysteresis},
       [](const Trends& t) { return has(t, Q::kStiffness, -1) && has(t, Q::kCreep, 1); }},
      {"its spring or tendon has become softer, or its force sensor reads less",
       {Q::kStiffness, Q::kZero},
       [](const Trends& t) { return has(t, Q::kStiffness, -1); }},
      {"its spring or tendon has become stiffer, or its force sensor reads more",
       {Q::kStiffness, Q::kZero},
       [](const Trends& t) { return has(t, Q::kStiffness, 1); }},
      {"its spring or tendon creeps more",
       {Q::kCreep, Q::kZero},
       [](const Trends& t) { return has(t, Q::kCreep, 1); }},
      {"its spring or tendon creeps less",
       {Q::kCreep},
       [](const Trends& t) { return has(t, Q::kCreep, -1); }},
      {"it has become longer, or slips",
       {Q::kZero},
       [](const Trends& t) { return has(t, Q::kZero, 1); }},
      {"it has become shorter, or its motor's zero has moved",
       {Q::kZero},
       [](const Trends& t) { return has(t, Q::kZero, -1); }},
      {"its force sensor's zero drifts",
       {Q::kForceOffset},
       [](const Trends& t) { return direction(t, Q::kForceOffset) != 0; }},
      {"its motor or gear rubs more: it wears, or runs dry",
       {Q::kFriction},
       [](const Trends& t) { return has(t, Q::kFriction, 1); }},
      {"its motor or gear rubs less than before",
       {Q::kFriction},
       [](const Trends& t) { return has(t, Q::kFriction, -1); }},
      {"it rubs at an eyelet, or its spring loses more",
       {Q::kHysteresis},
       [](const Trends& t) { return has(t, Q::kHysteresis, 1); }},
      {"it rubs less than before",
       {Q::kHysteresis},
       [](const Trends& t) { return has(t, Q::kHysteresis, -1); }},
      {"its motor's torque constant or its gear's losses have changed",
       {Q::kCurrentGain},
       [](const Trends& t) { return direction(t, Q::kCurrentGain) != 0; }},
      {"its motor's winding, brushes or a contact has another resistance",
       {Q::kResistance},
       [](const Trends& t) { return direction(t, Q::kResistance) != 0; }},
  };
  return all;
}

/// Whether a change is told as a share of what is normal.
bool is_relative(Quantity quantity) {
  return quantity == Quantity::kStiffness || quantity == Quantity::kCurrentGain ||
         quantity == Quantity::kResistance;
}

std::string change_text(Quantity quantity, const Trend& trend) {
  const bool relative = is_relative(quantity) && trend.normal != 0.0;
  const double size = relative ? 100.0 * trend.change() / std::abs(trend.normal) : trend.change();
  const std::string unit = relative ? "%" : unit_of(quantity);
  return std::string(name_of(quantity)) + (size > 0.0 ? " +" : " ") + short_number(size) +
         (unit == "1" ? "" : " " + unit);
}

Finding finding_of(const std::string& muscle, const Cause& cause, Trends& trends) {
  Finding finding{muscle, cause.words, {}, HUGE_VAL, {}};
  std::vector<std::string> changes;
  for (const Quantity quantity : cause.quantities) {
    if (direction(trends, quantity) == 0) continue;
    const Trend& trend = trends.at(quantity);
    finding.quantities.push_back(quantity);
    if (trend.days) finding.days = std::min(finding.days, *trend.days);
    changes.push_back(change_text(quantity, trend));
    trends.erase(quantity);
  }
  finding.evidence = joined(changes);
  return finding;
}

}  // namespace

std::string Finding::text() const {
  std::string line = muscle + ": " + cause + " (" + evidence + ")";
  if (days == 0.0) return line + "; beyond its limit";
  if (!std::isfinite(days)) return line;
  return line + "; reaches its limit in " + short_number(days) + " days";
}

std::vector<Finding> findings(const History& history, const HealthOptions& options) {
  std::vector<Finding> all;
  for (const std::string& muscle : history.muscles()) {
    Trends trends;
    for (int k = 0; k < kQuantities; ++k) {
      const auto quantity = static_cast<Quantity>(k);
      const auto trend = trend_of(quantity, history.series(muscle, quantity), options);
      if (trend) trends.emplace(quantity, *trend);
    }
    for (const Cause& cause : causes()) {
      if (cause.shows(trends)) all.push_back(finding_of(muscle, cause, trends));
    }
  }
  return all;
}

}  // namespace health
}  // namespace anthrob
