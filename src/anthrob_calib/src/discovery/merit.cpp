#include "anthrob_calib/discovery/merit.h"

#include <cstdio>

namespace anthrob {
namespace discovery {

namespace {

constexpr double kSignificance = 3.0;       ///< standard errors over blocks
constexpr double kFaintSignificance = 6.0;  ///< where no gap is above kRealGap
constexpr double kShareOfPresent = 0.1;
constexpr double kShareOfFirst = 0.03;
/// What is smaller beside the first gap may be what the shape of the first law leaves.
constexpr double kSmallSignificance = 8.0;

template <typename... Values>
std::string words(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

}  // namespace

std::string lack(const Merit& merit) {
  if (merit.probability <= merit.none) {
    return words("with probability %.2g none of those that were fitted is right", merit.none);
  }
  if (merit.evidence <= merit.needed_evidence) {
    return words("it gains %.1f nat on held-out data where more than %.1f are needed",
                 merit.evidence, merit.needed_evidence);
  }
  const double needed = merit.only_faint_gaps ? kFaintSignificance : kSignificance;
  if (merit.significance <= needed) {
    return words("its gain is %.2f standard errors where more than %.0f are needed",
                 merit.significance, needed);
  }
  if (merit.share <= 0.0) return "the squared gap on held-out data does not fall with it";
  if (merit.share <= kShareOfPresent) {
    return words(
        "it takes %.1f %% of the squared gap on held-out data where more than %.0f are needed",
        100.0 * merit.share, 100.0 * kShareOfPresent);
  }
  if (merit.share_of_first <= kShareOfFirst && merit.significance <= kSmallSignificance) {
    return words(
        "it takes %.1f %% of what the squared gap was at first, and may be what the effects "
        "before it leave: its gain is %.2f standard errors where more than %.0f are needed",
        100.0 * merit.share_of_first, merit.significance, kSmallSignificance);
  }
  return "";
}

}  // namespace discovery
}  // namespace anthrob
