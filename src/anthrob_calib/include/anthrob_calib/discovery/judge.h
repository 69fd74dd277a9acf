#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/noise_floor.h"

namespace anthrob {
namespace discovery {

/// Compares models by how well they predict, in log likelihood [nat], added up over blocks of time.
///
/// Two things are counted as they are and not as one would like them: the spread of a channel is
/// what the best model leaves (or the floor, if that is more), so that no model is praised for
/// noise that is not there; and bins that are correlated in what the best model leaves count less.
class Judge {
 public:
  static constexpr double kBlock = 2.0;  ///< [s] longer than what residuals remember

  /// @param whitener as the residuals were whitened with
  /// @param scales of channels whose whitener has their inflation in it; others: none
  Judge(const Experiments& experiments, const Eigen::VectorXf& whitener, const Scales& scales);

  std::size_t block_count() const { return blocks_; }

  /// Log score of each residual in each block: one row a residual.
  /// @param best index of the residual that defines spread and correlation
  Eigen::MatrixXd block_scores(const std::vector<Eigen::VectorXf>& residuals,
                               std::size_t best) const;

  /// Root mean square over all channels, in standard deviations.
  double gap(const Eigen::VectorXf& residual) const;
  /// The same by channel.
  std::map<std::string, double> channel_gaps(const Eigen::VectorXf& residual) const;
  /// A number of every bin's channel. @param other of channels that have none
  Eigen::VectorXf by_channel(const std::map<std::string, double>& numbers, double other) const;
  /// By what share of it chance moves each channel's gap (one standard deviation), where only noise
  /// is.
  std::map<std::string, double> chance_of_gaps() const;
  /// By how many standard errors over blocks each channel's mean square exceeds that of a gap; of
  /// channels that are measured in three blocks or more.
  std::map<std::string, double> excess_significance(const Eigen::VectorXf& residual,
                                                    double gap) const;

 private:
  struct Run {
    std::string name;
    Eigen::Index offset, count;
    double inflation;                ///< that the whitener has in it
    std::vector<std::size_t> block;  ///< of every bin
  };

  /// Of a run, without the bins in which nothing was measured.
  Eigen::VectorXf measured(const Eigen::VectorXf& residual, const Run& run) const;

  const Eigen::VectorXf& whitener_;
  std::vector<Run> runs_;
  std::size_t blocks_ = 0;
};

/// Whether some channel is above a gap both in what was learned from and in what was held out, and
/// not by chance: by three standard errors over the blocks of both, or above two floors, for no
/// estimate of the noise is that wrong.
bool certain_gap(const Judge& train, const Eigen::VectorXf& learned, const Judge& test,
                 const Eigen::VectorXf& held_out, double gap);

/// Share of (weighted) blocks' verdicts for each model: softmax of the total scores under the
/// Bayesian bootstrap (pseudo-BMA+, Yao et al. 2018). Deterministic by seed.
/// @param scores one row a model   @param handicap subtracted from each model's total [nat]
std::vector<double> model_probabilities(const Eigen::MatrixXd& scores,
                                        const std::vector<double>& handicap, std::uint64_t seed);

/// Mean of the blocks' gains over its standard error, of the gains as they are or of their
/// logarithms (asinh), the larger of the two: what brings ten nat in one block and a thousand in
/// the next is not doubtful for that, nor what brings much in some blocks and costs little in
/// others, as a law of nearly the right shape does. Blocks of less than a nat either way say
/// nothing: an effect may show now and then only. 0 if fewer than three say something.
double block_significance(const Eigen::VectorXd& gains);

}  // namespace discovery
}  // namespace anthrob
