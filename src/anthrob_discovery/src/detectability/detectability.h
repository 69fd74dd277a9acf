#pragma once

#include <string>
#include <vector>

#include "baseline/baseline.h"
#include "hypotheses/hypotheses.h"
#include "hypotheses/screening.h"

namespace anthrob {
namespace discovery {

/// The size from which on the recordings would show an effect.
struct Visibility {
  std::string id, place, unit;
  double smallest_visible = 0.0;  ///< of its most visible size parameter; infinite: none shows
};

/// What the recordings can show, before any effect is named: for each candidate the smallest size
/// that would be named nineteen times out of twenty, and the groups that nothing tells apart.
struct Detectability {
  std::vector<Visibility> visible, not_visible;
  std::vector<std::vector<Visibility>> alike;  ///< groups that these data cannot tell apart
};

/// To be named, an effect must gain enough on held-out recordings, and some channel must show a gap
/// without it ("What is visible" in docs/discovery_method.md).
/// @param base the fit of the ordinary parameters   @param scores of all candidates there
Detectability detect(const Hypotheses& hypotheses, const Fitted& base, const Screening& screening,
                     std::vector<Score> scores);

}  // namespace discovery
}  // namespace anthrob
