#include "anthrob_calib/discovery/number_text.h"

#include <cmath>
#include <cstdio>

namespace anthrob {
namespace discovery {

std::string short_number(double value) {
  if (!std::isfinite(value)) return "unlimited";
  const double size = std::abs(value);
  const bool is_whole = size >= 999.5 && size < 1e7;  // rather than 1.04e+03
  char text[32];
  std::snprintf(text, sizeof(text), is_whole ? "%.0f" : "%.3g", value);
  return text;
}

std::string precise_number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string duration_text(double seconds) {
  if (seconds < 120.0) return short_number(seconds) + " s";
  if (seconds < 7200.0) return short_number(std::round(seconds / 60.0)) + " min";
  return short_number(seconds / 3600.0) + " h";
}

std::string probability_text(double probability) {
  if (probability > 0.999) return "probability above 0.999";
  if (probability < 0.001) return "probability below 0.001";
  return "probability " + short_number(probability);
}

namespace {

/// What an interval does not say: that a wider range might have made it wider.
std::string end_text(const FoundParameter& p) {
  if (p.low_ends && p.high_ends) return ", where its range begins and ends";
  if (p.low_ends) return ", where its range begins";
  return p.high_ends ? ", where its range ends" : "";
}

}  // namespace

std::string range_text(const FoundParameter& p) {
  if (p.known) return "taken as known";
  if (p.undetermined) return "not determined by these recordings";
  return short_number(p.low) + " to " + short_number(p.high) + end_text(p);
}

std::string interval_text(const FoundParameter& p) {
  const std::string unit = p.unit == "1" ? "" : " " + p.unit;
  if (!p.has_interval()) return short_number(p.value) + unit + ", " + range_text(p);
  return short_number(p.value) + " [" + short_number(p.low) + ", " + short_number(p.high) + "]" +
         unit + end_text(p);
}

}  // namespace discovery
}  // namespace anthrob
