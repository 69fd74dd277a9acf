#pragma once

#include <optional>
#include <vector>

#include "hypotheses/hypotheses.h"
#include "hypotheses/screening.h"

namespace anthrob {
namespace discovery {

/// One law instead of several named effects. Two laws at one place may be one law of more sizes:
/// friction plus a constant torque is friction that differs by direction. And one law at several
/// places may be the same law everywhere, with one size.
class CommonLaw {
 public:
  /// An effect in a fit: its index in there, and which candidate it is.
  struct Part {
    std::size_t effect, candidate;
  };

  CommonLaw(const Hypotheses& hypotheses, Screening& screening)
      : hypotheses_(hypotheses), screening_(screening) {}

  /// Whether a candidate may replace two others.
  bool may_be(std::size_t law, std::size_t one, std::size_t other) const;
  /// The candidate that is the law of these parts everywhere; nothing if there is none.
  std::optional<std::size_t> everywhere(const std::vector<Part>& parts) const;
  /// A law in place of others: the fit with it, its odds against them, and by how much it reduces
  /// the cost of the model without any of them.
  struct Instead {
    Tested tested;
    CandidateComparison::Odds odds;
    double gained;
    Eigen::VectorXf without;  ///< held-out residual of the model without any of them

    bool is_better(const CommonLawOptions& options) const;
    /// Whether it is so much better that it is named instead of them.
    bool is_clearly_better(const CommonLawOptions& options) const;
  };
  /// Fits a candidate to the end in place of some effects; it becomes the last effect of the fit.
  /// @param with the fit to the end with all those effects   @param parts the effects that are
  /// replaced, in the order of the fit
  /// @return nothing if a rough fit with it still lacks more than half of what they gain, or if it
  /// cannot be simulated
  std::optional<Instead> instead(std::size_t law, const Tested& with,
                                 const std::vector<Part>& parts) const;

 private:
  const Hypotheses& hypotheses_;
  Screening& screening_;
};

}  // namespace discovery
}  // namespace anthrob
