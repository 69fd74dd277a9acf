#pragma once

#include <cstddef>
#include <vector>

namespace anthrob {
namespace discovery {

/// Which step of a variable, or which cell of two, every bin of a channel is in.
struct Steps {
  std::vector<std::size_t> of;  ///< by bin
  std::size_t count = 0;
};

/// Steps with equal numbers of bins, fewer where values repeat.
/// @param x values of the variable, by bin
Steps equal_steps(const std::vector<double>& x, std::size_t most);
/// Negative, still, positive. @param still a smaller size than this counts as still
Steps sign_steps(const std::vector<double>& x, double still);
/// Every step of one variable with every step of another.
Steps crossed(const Steps& one, const Steps& other);

/// The residual of one channel at its bins.
struct ChannelResidual {
  std::vector<double> y;           ///< [unit of the channel]
  std::vector<std::size_t> block;  ///< number of the block of time; bins of a block lie together

  bool is_odd(std::size_t bin) const { return block[bin] % 2 == 1; }
};

/// Means of one half of the blocks, by step.
struct StepMeans {
  double fewest = 1.0;        ///< bins of a mean
  std::vector<double> count;  ///< bins
  /// Residual, and its standard error over blocks, within which residuals are correlated [its
  /// unit].
  std::vector<double> mean, error;

  /// Whether there are enough bins for a mean.
  bool has(std::size_t step) const;
};

/// @param odd which half   @param fewest bins of a mean
StepMeans means_of(const ChannelResidual& residual, const Steps& steps, bool odd, double fewest);
/// Means of a variable, by step, over the same bins.
std::vector<double> centres_of(const std::vector<double>& x, const ChannelResidual& residual,
                               const Steps& steps, bool odd, double fewest);

/// Shares of the squares of one half of the blocks that means of the other half predict, averaged
/// over both halves.
struct Predicted {
  double constant = 0.0;  ///< by one mean
  double steps = 0.0;     ///< by those of the steps, beyond that
};

/// @param wider steps whose means predict where a step has too few bins; nullptr: nothing does
Predicted predicted(const ChannelResidual& residual, const Steps& steps, double fewest,
                    const Steps* wider = nullptr);

}  // namespace discovery
}  // namespace anthrob
