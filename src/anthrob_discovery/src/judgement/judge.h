#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "experiment/noise_floor.h"
#include "options/judgement.h"

namespace anthrob {
namespace discovery {

/// Compares models by how well they predict, in log likelihood [nat], added up over blocks of time.
///
/// The spread of a channel is what the best model leaves in it, or the floor if that is larger.
/// Bins count less where what the best model leaves is correlated.
class Judge {
 public:
  /// Blocks of a recording; a rest shorter than half a block belongs to the last one.
  /// @param duration [s]
  static std::size_t blocks_of(double duration, const JudgementOptions& options);

  /// @param whitener with which the residuals were whitened
  /// @param scales scales of the channels if the whitener includes their inflation; else empty
  Judge(const Experiments& experiments, const Eigen::VectorXf& whitener, const Scales& scales,
        const JudgementOptions& options);

  const JudgementOptions& options() const { return options_; }

  std::size_t block_count() const { return blocks_; }

  /// Log score of each residual in each block: one row a residual.
  /// @param best index of the residual that defines spread and correlation
  Eigen::MatrixXd block_scores(const std::vector<Eigen::VectorXf>& residuals,
                               std::size_t best) const;

  /// Root mean square over all channels, in standard deviations.
  double gap(const Eigen::VectorXf& residual) const;
  /// The same by channel.
  std::map<std::string, double> channel_gaps(const Eigen::VectorXf& residual) const;
  /// Expands numbers by channel to one number a bin. @param other number of channels that are not
  /// in the map
  Eigen::VectorXf by_channel(const std::map<std::string, double>& numbers, double other) const;
  /// Relative standard deviation of each channel's gap where there is nothing but noise.
  std::map<std::string, double> chance_of_gaps() const;
  /// By how many standard errors over blocks each channel's mean square exceeds the square of
  /// `gap`; only of channels that are measured in three blocks or more.
  std::map<std::string, double> excess_significance(const Eigen::VectorXf& residual,
                                                    double gap) const;
  /// By how many standard errors over blocks each channel's mean square is larger with one residual
  /// than with another; of the same channels.
  std::map<std::string, double> growth_significance(const Eigen::VectorXf& before,
                                                    const Eigen::VectorXf& after) const;

 private:
  struct Run {
    std::string name;
    Eigen::Index offset, count;
    double inflation;                ///< included in the whitener
    std::vector<std::size_t> block;  ///< of every bin
  };

  /// The residual of a run, without the bins in which nothing was measured.
  Eigen::VectorXf measured(const Eigen::VectorXf& residual, const Run& run) const;
  /// Mean square of each channel in each block in which it is measured [standard deviations^2]; of
  /// channels that are measured in three blocks or more.
  std::map<std::string, std::vector<double>> mean_squares(const Eigen::VectorXf& residual) const;

  const Eigen::VectorXf& whitener_;
  JudgementOptions options_;
  std::vector<Run> runs_;
  std::size_t blocks_ = 0;
};

/// Whether some channel is above `gap` both in training and in held-out recordings, and not by
/// chance: by three standard errors over the blocks of both, or above two floors, since no noise
/// estimate is that wrong.
bool certain_gap(const Judge& train, const Eigen::VectorXf& learned, const Judge& test,
                 const Eigen::VectorXf& held_out, double gap);

/// Probability of each model: softmax of the total scores under the
/// Bayesian bootstrap (pseudo-BMA+, Yao et al. 2018). Deterministic by seed.
/// @param scores one row a model   @param handicap subtracted from each model's total [nat]
std::vector<double> model_probabilities(const Eigen::MatrixXd& scores,
                                        const std::vector<double>& handicap, std::uint64_t seed,
                                        const JudgementOptions& options);

/// Mean gain of the blocks over its standard error, computed for the gains and for asinh(gain); the
/// larger of the two is returned. asinh avoids calling an effect doubtful because it gains ten nat
/// in one block and a thousand in the next, or because it gains much in some blocks and costs
/// little in others. Blocks with a gain between -1 and 1 nat are left out, because an effect may
/// show only now and then. 0 if fewer than three blocks are left.
double block_significance(const Eigen::VectorXd& gains, const JudgementOptions& options);

}  // namespace discovery
}  // namespace anthrob
