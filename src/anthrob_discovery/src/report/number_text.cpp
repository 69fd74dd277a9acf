#include "report/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace anthrob {
namespace discovery {

std::string precise_number(double value) {
  return significant(value, 6);
}

std::string probability_text(double probability) {
  if (probability > 0.999) return "probability above 0.999";
  if (probability < 0.001) return "probability below 0.001";
  return "probability " + short_number(probability);
}

namespace {

/// Three significant digits, or as many as show the width of the interval: of 1.00592, whose
/// neutral value is 1, three would show nothing.
std::string separable(double number, const FoundParameter& p) {
  const double width = p.high - p.low, most = std::max(std::abs(p.low), std::abs(p.high));
  if (!p.has_interval() || !(width > 0.0) || !std::isfinite(width)) return short_number(number);
  const int most_digits = 9;
  const double first = std::floor(std::log10(most));  // decade of the first digit
  int digits = 3;
  while (digits < most_digits && std::pow(10.0, first + 1 - digits) > 0.5 * width) ++digits;
  if (digits == 3) return short_number(number);
  const bool is_whole = std::abs(number) >= std::pow(10.0, digits) && std::abs(number) < 1e7;
  char text[32];
  std::snprintf(text, sizeof(text), is_whole ? "%.*f" : "%.*g", is_whole ? 0 : digits, number);
  return text;
}

/// What an interval does not say: that a wider range might have made it wider.
std::string end_text(const FoundParameter& p) {
  if (p.low_ends && p.high_ends) return ", where its range begins and ends";
  if (p.low_ends) return ", where its range begins";
  return p.high_ends ? ", where its range ends" : "";
}

}  // namespace

std::string value_text(const FoundParameter& p) {
  return separable(p.value, p);
}

std::string range_text(const FoundParameter& p) {
  if (p.known) return "taken as known";
  if (p.undetermined) return "not determined by these recordings";
  if (p.at_bound) return "at the end of its range; it may lie beyond";
  return separable(p.low, p) + " to " + separable(p.high, p) + end_text(p);
}

std::string interval_text(const FoundParameter& p) {
  const std::string unit = p.unit == "1" ? "" : " " + p.unit;
  if (!p.has_interval()) return value_text(p) + unit + ", " + range_text(p);
  return value_text(p) + " [" + separable(p.low, p) + ", " + separable(p.high, p) + "]" + unit +
         end_text(p);
}

}  // namespace discovery
}  // namespace anthrob
