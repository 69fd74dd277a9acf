#include "judgement/judge.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace discovery {

namespace {

/// 0 if there are too few.
double mean_over_its_error(const std::vector<double>& values, std::size_t fewest) {
  if (values.size() < fewest) return 0.0;
  const auto n = static_cast<double>(values.size());
  const Eigen::Map<const Eigen::ArrayXd> value(values.data(),
                                               static_cast<Eigen::Index>(values.size()));
  const double mean = value.mean();
  const double variance = (value - mean).square().sum() / (n - 1.0);
  return variance > 0.0 ? mean / std::sqrt(variance / n) : 0.0;
}

}  // namespace

std::size_t Judge::blocks_of(double duration, const JudgementOptions& options) {
  return static_cast<std::size_t>(std::max(1L, std::lround(duration / options.block)));
}

Judge::Judge(const Experiments& experiments, const Eigen::VectorXf& whitener, const Scales& scales,
             const JudgementOptions& options)
    : whitener_(whitener), options_(options) {
  std::size_t offset = 0;
  for (const auto& experiment : experiments) {
    const std::size_t own = blocks_of(experiment->duration(), options);
    for (const Channel& channel : experiment->channels()) {
      const auto scale = scales.find(channel.name());
      Run run{channel.name(),
              static_cast<Eigen::Index>(offset + channel.offset),
              static_cast<Eigen::Index>(channel.count),
              scale == scales.end() ? 1.0 : scale->second.inflation,
              {}};
      for (std::size_t b = 0; b < channel.count; ++b) {
        const auto block = static_cast<std::size_t>(experiment->bin_time(b) / options.block);
        run.block.push_back(blocks_ + std::min(block, own - 1));
      }
      runs_.push_back(std::move(run));
    }
    blocks_ += own;
    offset += experiment->size();
  }
}

Eigen::VectorXf Judge::measured(const Eigen::VectorXf& residual, const Run& run) const {
  std::vector<float> values;
  for (Eigen::Index b = run.offset; b < run.offset + run.count; ++b) {
    if (whitener_[b] > 0.0f) values.push_back(residual[b]);
  }
  return Eigen::Map<Eigen::VectorXf>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Eigen::MatrixXd Judge::block_scores(const std::vector<Eigen::VectorXf>& residuals,
                                    std::size_t best) const {
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(residuals.size()),
                                                 static_cast<Eigen::Index>(blocks_));
  // A channel's spread is one number over all its components and recordings.
  std::map<std::string, std::array<double, 3>> left;  // squares, bins, correlation-weighted bins
  for (const Run& run : runs_) {
    const Eigen::VectorXf own = measured(residuals[best], run);
    const auto bins = static_cast<double>(own.size());
    auto& sums = left[run.name];
    sums[0] += own.cast<double>().squaredNorm();
    sums[1] += bins;
    sums[2] += bins * correlation_length(own);
  }
  for (const Run& run : runs_) {
    const auto& sums = left[run.name];
    if (!(sums[1] > 0.0)) continue;
    // The whitener includes the floor's correlation, so the variance is smaller by that factor.
    const double variance = std::max(1.0 / run.inflation, sums[0] / sums[1]);
    const double weight = 0.5 / (variance * std::max(1.0, sums[2] / sums[1]));
    for (std::size_t r = 0; r < residuals.size(); ++r) {
      for (Eigen::Index b = 0; b < run.count; ++b) {
        const double y = residuals[r][run.offset + b];
        scores(static_cast<Eigen::Index>(r),
               static_cast<Eigen::Index>(run.block[static_cast<std::size_t>(b)])) -= weight * y * y;
      }
    }
  }
  return scores;
}

double Judge::gap(const Eigen::VectorXf& residual) const {
  double sum = 0.0;
  const auto gaps = channel_gaps(residual);
  for (const auto& [name, value] : gaps) sum += value * value;
  return gaps.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(gaps.size()));
}

std::map<std::string, double> Judge::channel_gaps(const Eigen::VectorXf& residual) const {
  std::map<std::string, std::array<double, 2>> sums;
  for (const Run& run : runs_) {
    auto& sum = sums[run.name];
    sum[0] += run.inflation * residual.segment(run.offset, run.count).cast<double>().squaredNorm();
    sum[1] +=
        static_cast<double>((whitener_.segment(run.offset, run.count).array() > 0.0f).count());
  }
  std::map<std::string, double> gaps;
  for (const auto& [name, sum] : sums) {
    if (sum[1] > 0.0) gaps[name] = std::sqrt(sum[0] / sum[1]);
  }
  return gaps;
}

Eigen::VectorXf Judge::by_channel(const std::map<std::string, double>& numbers,
                                  double other) const {
  Eigen::VectorXf bins(whitener_.size());
  for (const Run& run : runs_) {
    const auto found = numbers.find(run.name);
    const double number = found == numbers.end() ? other : found->second;
    bins.segment(run.offset, run.count).setConstant(static_cast<float>(number));
  }
  return bins;
}

std::map<std::string, double> Judge::chance_of_gaps() const {
  std::map<std::string, double> independent;  // bins
  for (const Run& run : runs_) {
    const auto measured = (whitener_.segment(run.offset, run.count).array() > 0.0f).count();
    independent[run.name] += static_cast<double>(measured) / run.inflation;
  }
  std::map<std::string, double> chance;
  for (const auto& [name, count] : independent) {
    if (count > 0.0) chance[name] = 1.0 / std::sqrt(2.0 * count);
  }
  return chance;
}

std::map<std::string, std::vector<double>> Judge::mean_squares(
    const Eigen::VectorXf& residual) const {
  const auto count = static_cast<Eigen::Index>(blocks_);
  std::map<std::string, std::pair<Eigen::ArrayXd, Eigen::ArrayXd>> sums;  // squares, bins
  for (const Run& run : runs_) {
    auto& [squares, bins] = sums[run.name];
    if (squares.size() == 0) squares = bins = Eigen::ArrayXd::Zero(count);
    for (Eigen::Index b = 0; b < run.count; ++b) {
      if (!(whitener_[run.offset + b] > 0.0f)) continue;
      const auto block = static_cast<Eigen::Index>(run.block[static_cast<std::size_t>(b)]);
      const double value = residual[run.offset + b];
      squares[block] += run.inflation * value * value;
      bins[block] += 1.0;
    }
  }
  std::map<std::string, std::vector<double>> means;
  for (const auto& [name, sum] : sums) {
    std::vector<double> of_blocks;
    for (Eigen::Index block = 0; block < count; ++block) {
      if (sum.second[block] > 0.0) of_blocks.push_back(sum.first[block] / sum.second[block]);
    }
    if (of_blocks.size() >= options_.fewest_blocks) means[name] = std::move(of_blocks);
  }
  return means;
}

std::map<std::string, double> Judge::excess_significance(const Eigen::VectorXf& residual,
                                                         double gap) const {
  std::map<std::string, double> significance;
  for (const auto& [name, squares] : mean_squares(residual)) {
    std::vector<double> excesses = squares;
    for (double& excess : excesses) excess -= gap * gap;
    significance[name] = mean_over_its_error(excesses, options_.fewest_blocks);
  }
  return significance;
}

std::map<std::string, double> Judge::growth_significance(const Eigen::VectorXf& before,
                                                         const Eigen::VectorXf& after) const {
  std::map<std::string, double> significance;
  const auto earlier = mean_squares(before);
  for (const auto& [name, squares] : mean_squares(after)) {
    std::vector<double> growths = squares;
    for (std::size_t i = 0; i < growths.size(); ++i) growths[i] -= earlier.at(name)[i];
    significance[name] = mean_over_its_error(growths, options_.fewest_blocks);
  }
  return significance;
}

bool certain_gap(const Judge& train, const Eigen::VectorXf& learned, const Judge& test,
                 const Eigen::VectorXf& held_out, double gap) {
  const JudgementOptions& options = train.options();
  const auto in = [](const std::map<std::string, double>& channels, const std::string& name) {
    const auto found = channels.find(name);
    return found == channels.end() ? 0.0 : found->second;
  };
  const auto gaps = train.channel_gaps(learned);
  const auto sure = train.excess_significance(learned, gap);
  const auto sure_of_held_out = test.excess_significance(held_out, gap);
  for (const auto& [name, other] : test.channel_gaps(held_out)) {
    const double least = std::min(other, in(gaps, name));
    const double significance = (in(sure, name) + in(sure_of_held_out, name)) / M_SQRT2;
    if (least > options.certain_gap || (least > gap && significance > options.sure)) return true;
  }
  return false;
}

std::vector<double> model_probabilities(const Eigen::MatrixXd& scores,
                                        const std::vector<double>& handicap, std::uint64_t seed,
                                        const JudgementOptions& options) {
  const Eigen::Index models = scores.rows(), blocks = scores.cols();
  std::vector<double> probability(static_cast<std::size_t>(models), 0.0);
  const CounterRandom random(seed, 77);
  Eigen::VectorXd weight(blocks);
  std::uint64_t index = 0;
  for (int draw = 0; draw < options.draws; ++draw) {
    // Dirichlet(1, ..., 1) times the number of blocks.
    for (Eigen::Index b = 0; b < blocks; ++b) weight[b] = -std::log(random.uniform(index++));
    weight *= static_cast<double>(blocks) / weight.sum();
    Eigen::VectorXd total = scores * weight;
    for (Eigen::Index m = 0; m < models; ++m) total[m] -= handicap[static_cast<std::size_t>(m)];
    const Eigen::VectorXd share = (total.array() - total.maxCoeff()).exp();
    for (Eigen::Index m = 0; m < models; ++m) {
      probability[static_cast<std::size_t>(m)] += share[m] / share.sum() / options.draws;
    }
  }
  for (double& p : probability) p = std::min(p, 1.0);  // not for rounding above it
  return probability;
}

double block_significance(const Eigen::VectorXd& gains, const JudgementOptions& options) {
  std::vector<double> telling, sizes;
  for (const double gain : gains) {
    if (!(std::abs(gain) > options.telling_gain)) continue;
    telling.push_back(gain);
    sizes.push_back(std::asinh(gain));
  }
  return std::max(mean_over_its_error(telling, options.fewest_blocks),
                  mean_over_its_error(sizes, options.fewest_blocks));
}

}  // namespace discovery
}  // namespace anthrob
