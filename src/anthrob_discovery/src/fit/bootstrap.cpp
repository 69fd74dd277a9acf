#include "fit/bootstrap.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "anthrob_core/random.h"
#include "experiment/regimes.h"
#include "fit/bounded_minimum.h"
#include "judgement/judge.h"
#include "judgement/quantiles.h"

namespace anthrob {
namespace discovery {

namespace {

/// Normal equations of some rows.
struct Block {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;

  explicit Block(Eigen::Index n)
      : information(Eigen::MatrixXd::Zero(n, n)), gradient(Eigen::VectorXd::Zero(n)) {}
};

/// @param seconds length of a block
std::vector<Block> blocks_of_time(const Fitted& fitted, const Experiments& experiments,
                                  double seconds) {
  std::vector<Block> blocks;
  std::size_t offset = 0;
  for (const auto& experiment : experiments) {
    const std::size_t per_block =
        std::max<std::size_t>(1, static_cast<std::size_t>(seconds / experiment->bin()));
    const std::size_t bins = experiment->channels().front().count;
    // A shorter rest belongs to the last block.
    const std::size_t own = std::max<std::size_t>(1, (bins + per_block / 2) / per_block);
    for (std::size_t k = 0; k < own; ++k) {
      Block block(fitted.sensitivity.cols());
      const std::size_t from = k * per_block, to = k + 1 < own ? from + per_block : bins;
      for (const Channel& channel : experiment->channels()) {
        const std::size_t count = std::min(to, channel.count) - std::min(from, channel.count);
        if (count == 0) continue;
        const auto at = static_cast<Eigen::Index>(offset + channel.offset + from);
        const auto rows = static_cast<Eigen::Index>(count);
        const auto J = fitted.sensitivity.middleRows(at, rows);
        block.information += (J.transpose() * J).cast<double>();
        block.gradient += (J.transpose() * fitted.residual.segment(at, rows)).cast<double>();
      }
      blocks.push_back(std::move(block));
    }
    offset += experiment->size();
  }
  return blocks;
}

std::vector<Block> blocks_of_regimes(const Fitted& fitted, const Experiments& experiments,
                                     const std::vector<MeasuredVariable>& variables) {
  std::vector<Block> blocks;
  const auto n = fitted.sensitivity.cols();
  for (const Channel& channel : channels_of(experiments)) {
    const auto regimes = regimes_of(channel.place, variables);
    std::vector<Block> own(kLevels * kLevels, Block(n));
    std::vector<char> used(own.size(), 0);
    std::size_t offset = 0;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const Channel* own_channel = find_channel(*experiments[e], channel);
      for (std::size_t b = 0; own_channel && b < own_channel->count; ++b) {
        std::size_t which = 0;
        for (const Regime& regime : regimes) {
          which = kLevels * which + static_cast<std::size_t>(regime.levels[e][b]);
        }
        const auto at = static_cast<Eigen::Index>(offset + own_channel->offset + b);
        const Eigen::VectorXd row = fitted.sensitivity.row(at).cast<double>();
        own[which].information.selfadjointView<Eigen::Lower>().rankUpdate(row);
        own[which].gradient += static_cast<double>(fitted.residual[at]) * row;
        used[which] = 1;
      }
      offset += experiments[e]->size();
    }
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (!used[k]) continue;
      own[k].information = own[k].information.selfadjointView<Eigen::Lower>();
      blocks.push_back(std::move(own[k]));
    }
  }
  return blocks;
}

/// Half of the 95 % interval of each unknown, in its unit, by resampling blocks. What resampling
/// finds may lie beside the fit itself, which is not linear: that counts on both sides.
std::vector<double> resample(const Fitted& fitted, const std::vector<Block>& blocks,
                             std::uint64_t seed, const IntervalOptions& options) {
  const auto n = static_cast<Eigen::Index>(fitted.unknowns.size());
  const Eigen::VectorXd x = fitted.scaled(), precision = fitted.precision();
  const Eigen::VectorXd prior = precision.cwiseProduct(x - fitted.expected());
  const Eigen::VectorXd lower = fitted.lower_room(), upper = fitted.upper_room();
  const CounterRandom random(seed, 78);
  std::uint64_t index = 0;
  std::vector<std::vector<double>> draws(static_cast<std::size_t>(n));
  for (int draw = 0; draw < options.draws; ++draw) {
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd gradient = prior;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const auto pick = std::min(
          blocks.size() - 1,
          static_cast<std::size_t>(random.uniform(index++) * static_cast<double>(blocks.size())));
      information += blocks[pick].information;
      gradient += blocks[pick].gradient;
    }
    information.diagonal() += precision;
    regularise(information);
    const Eigen::VectorXd step = bounded_minimum(information, gradient, lower, upper);
    for (Eigen::Index i = 0; i < n; ++i) {
      draws[static_cast<std::size_t>(i)].push_back(
          (x[i] + step[i]) * fitted.unknowns[static_cast<std::size_t>(i)].scale);
    }
  }
  std::vector<double> reach;
  // Resampling n blocks underestimates their spread by sqrt((n - 1) / n).
  const auto count = static_cast<double>(blocks.size());
  const double widen = std::sqrt(count / std::max(1.0, count - 1.0));
  for (Eigen::Index i = 0; i < n; ++i) {
    auto& values = draws[static_cast<std::size_t>(i)];
    std::sort(values.begin(), values.end());
    const double at = x[i] * fitted.unknowns[static_cast<std::size_t>(i)].scale;
    const double low =
        values[static_cast<std::size_t>(0.5 * (1.0 - options.confidence) * options.draws)];
    const double high =
        values[static_cast<std::size_t>(0.5 * (1.0 + options.confidence) * options.draws)];
    reach.push_back(widen * std::max({0.0, at - low, high - at}));
  }
  return reach;
}

/// The same if there were nothing but the floor's noise. Ordinary parameters that cannot move, held
/// or at a bound, take nothing from the others.
std::vector<double> reach_of_noise(const Fitted& fitted, double at_bound, double deviations) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
    if (fitted.at_bound(i, at_bound) && fitted.unknowns[i].effect < 0) continue;
    free.push_back(static_cast<Eigen::Index>(i));
  }
  std::vector<double> reach(fitted.unknowns.size(), 0.0);
  if (free.empty()) return reach;
  const Eigen::MatrixXf sensitivity = fitted.sensitivity(Eigen::all, free);
  const auto n = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd information = (sensitivity.transpose() * sensitivity).cast<double>();
  information.diagonal() += fitted.precision()(free);
  regularise(information);
  const Eigen::MatrixXd covariance = information.ldlt().solve(Eigen::MatrixXd::Identity(n, n));
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(free[static_cast<std::size_t>(k)]);
    reach[i] = deviations * std::sqrt(std::max(0.0, covariance(k, k))) * fitted.unknowns[i].scale;
  }
  return reach;
}

/// What all sizes of an effect together do to the residual, linearly (Euclidean norm).
double response_to(const Fitted& fitted, int effect) {
  Eigen::VectorXf response = Eigen::VectorXf::Zero(fitted.residual.size());
  for (std::size_t i = 0; i < fitted.unknowns.size(); ++i) {
    const Unknown& u = fitted.unknowns[i];
    if (u.effect != effect || !u.neutral) continue;
    const double amount = (u.read(fitted.variant) - *u.neutral) / u.scale;
    response += static_cast<float>(amount) * fitted.sensitivity.col(static_cast<Eigen::Index>(i));
  }
  return static_cast<double>(response.norm());
}

/// By how much another law of the same name may move an effect's parameters: little where the
/// effect stands alone, much where ordinary parameters imitate most of it and the rest is read off
/// details.
std::vector<double> reach_of_other_law(const Fitted& fitted, const std::vector<double>& noise,
                                       const IntervalOptions& options) {
  std::vector<double> reach(noise.size(), 0.0);
  for (std::size_t i = 0; i < reach.size(); ++i) {
    const int effect = fitted.unknowns[i].effect;
    if (effect >= 0) reach[i] = options.other_law * response_to(fitted, effect) * noise[i];
  }
  return reach;
}

}  // namespace

std::vector<std::pair<double, double>> bootstrap_intervals(
    const Fitted& fitted, const Experiments& experiments,
    const std::vector<MeasuredVariable>& variables, std::uint64_t seed, const FitOptions& fit,
    double block) {
  if (fitted.unknowns.empty()) return {};
  const IntervalOptions& options = fit.intervals;
  const std::vector<Block> blocks = blocks_of_time(fitted, experiments, block);
  std::vector<double> time = resample(fitted, blocks, seed, options);
  const std::vector<double> regimes =
      resample(fitted, blocks_of_regimes(fitted, experiments, variables), seed, options);
  const std::vector<double> noise =
      reach_of_noise(fitted, fit.convergence.at_bound, two_sided_deviations(options.confidence));
  const std::vector<double> other_law = reach_of_other_law(fitted, noise, options);
  for (std::size_t i = 0; blocks.size() < options.few_blocks && i < time.size(); ++i) {
    time[i] = std::max(time[i], noise[i]);
  }
  std::vector<std::pair<double, double>> intervals;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const Unknown& u = fitted.unknowns[i];
    const double at = u.read(fitted.variant);
    // Noise is in both and counts once.
    const double shape = std::sqrt(std::max(0.0, regimes[i] * regimes[i] - noise[i] * noise[i]));
    const double reach = std::hypot(time[i], shape, other_law[i]);
    intervals.emplace_back(std::clamp(at - reach, u.lower, at),
                           std::clamp(at + reach, at, u.upper));
  }
  return intervals;
}

}  // namespace discovery
}  // namespace anthrob
