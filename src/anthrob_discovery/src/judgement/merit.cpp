#include "judgement/merit.h"

#include <cstdio>

namespace anthrob {
namespace discovery {

namespace {

template <typename... Values>
std::string words(const char* format, Values... values) {
  char text[200];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

}  // namespace

std::optional<std::string> lack(const Merit& merit, const MeritOptions& options) {
  if (merit.probability <= merit.none) {
    return words(
        "it is no more probable than that none of the fitted candidates is right "
        "(probability %.2g)",
        merit.none);
  }
  // What got worse where it was learned has only undone what the ordinary parameters had learned.
  if (merit.learned <= 0.0) return "it does not fit the training recordings better";
  if (merit.evidence <= merit.needed_evidence) {
    return words("it gains only %.1f nat on held-out recordings; more than %.1f are required",
                 merit.evidence, merit.needed_evidence);
  }
  const double needed = merit.only_faint_gaps ? options.faint_significance : options.significance;
  if (merit.significance <= needed) {
    return words("its gain is only %.2f standard errors; more than %.0f are required",
                 merit.significance, needed);
  }
  if (merit.share <= 0.0) return "it does not reduce the squared gap on held-out recordings";
  if (merit.share <= options.share_of_present) {
    return words(
        "it removes only %.1f %% of the squared gap on held-out recordings; more than %.0f %% are "
        "required",
        100.0 * merit.share, 100.0 * options.share_of_present);
  }
  if (merit.share_of_first <= options.share_of_first &&
      merit.significance <= options.small_significance) {
    return words(
        "it removes only %.1f %% of the initial squared gap, which may be what earlier effects "
        "leave; its gain is %.2f standard errors, and for so little, more than %.0f are required",
        100.0 * merit.share_of_first, merit.significance, options.small_significance);
  }
  return std::nullopt;
}

}  // namespace discovery
}  // namespace anthrob
