#include "diagnosis/dependence.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/step_means.h"
#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

namespace {

const bool kShown = true;  ///< the half of the blocks whose curves are shown

/// A bin of a channel: experiment, and number of its bin.
using Bin = std::pair<std::size_t, std::size_t>;

/// One channel, and what it might depend on.
class ChannelBins {
 public:
  ChannelBins(const Experiments& experiments, const Channel& channel,
              const Eigen::VectorXf& residual, const Eigen::VectorXf& whitener,
              const DependenceOptions& options, double block_seconds)
      : options_(options) {
    std::size_t offset = 0, before = 0;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      const Experiment& experiment = *experiments[e];
      const Channel* c = find_channel(experiment, channel);
      for (std::size_t b = 0; c && b < c->count; ++b) {
        const auto i = static_cast<Eigen::Index>(offset + c->offset + b);
        if (!(whitener[i] > 0.0f)) continue;
        bins_.emplace_back(e, b);
        residual_.y.push_back(static_cast<double>(residual[i] / whitener[i]));
        const auto block = static_cast<std::size_t>(experiment.bin_time(b) / block_seconds);
        // Numbered on from experiment to experiment, so that odd ones begin every other.
        residual_.block.push_back(before + block + e % 2);
      }
      offset += experiment.size();
      if (!residual_.block.empty()) before = residual_.block.back() + 2;
      before += before % 2;
    }
  }

  bool are_enough() const { return bins_.size() >= options_.bins_per_step * options_.steps; }
  const ChannelResidual& residual() const { return residual_; }

  std::vector<double> values_of(const MeasuredVariable& variable) const {
    std::vector<double> x;
    for (const auto& [e, b] : bins_) x.push_back(variable.values[e][b]);
    return x;
  }

  Steps steps_of(const MeasuredVariable& variable, std::size_t most) const {
    const std::vector<double> x = values_of(variable);
    if (!variable.sign) return equal_steps(x, most);
    double largest = 0.0;
    for (const double value : x) largest = std::max(largest, std::abs(value));
    return sign_steps(x, options_.still * largest);
  }

  /// Over a variable, in some of the cells.
  Dependence::Curve curve(const MeasuredVariable& variable, const Steps& cells, std::size_t first,
                          std::size_t last, std::size_t stride = 1) const {
    const StepMeans means = means_of(residual_, cells, kShown, options_.fewest_bins);
    const auto centres =
        centres_of(values_of(variable), residual_, cells, kShown, options_.fewest_bins);
    Dependence::Curve curve;
    for (std::size_t k = first; k < last; k += stride) {
      if (!means.has(k)) continue;
      curve.at.push_back(centres[k]);
      curve.mean.push_back(means.mean[k]);
      curve.error.push_back(means.error[k]);
    }
    return curve;
  }

 private:
  const DependenceOptions& options_;
  std::vector<Bin> bins_;
  ChannelResidual residual_;
};

/// Quantities of other muscles explain a muscle too easily by chance; joints move all muscles.
std::vector<const MeasuredVariable*> that_may_explain(
    const Channel& channel, const std::vector<MeasuredVariable>& variables) {
  std::vector<const MeasuredVariable*> some;
  for (const MeasuredVariable& variable : variables) {
    const bool own = variable.owner() == channel.place || variable.name == "time";
    const bool muscle =
        variable.word == "load" || variable.word == "current" || variable.word == "wrap angle";
    if (own || !muscle) some.push_back(&variable);
  }
  return some;
}

/// The second quantity with which the curve over a first one predicts most, if clearly more than
/// without it.
std::optional<Dependence::Second> second_of(const ChannelBins& bins, const MeasuredVariable& first,
                                            double share,
                                            const std::vector<const MeasuredVariable*>& others,
                                            const DependenceOptions& options) {
  const Steps steps = bins.steps_of(first, options.steps);
  std::optional<Dependence::Second> best;
  double least = share + options.telling;
  for (const MeasuredVariable* other : others) {
    if (other == &first) continue;
    const Steps levels = bins.steps_of(*other, options.levels);
    const Steps cells = crossed(steps, levels);
    const double both = predicted(bins.residual(), cells, options.fewest_bins, &steps).steps;
    if (both <= least) continue;
    least = both + options.better;
    best = Dependence::Second{other->name, other->unit, other->word, both, {}};
    const auto centres =
        centres_of(bins.values_of(*other), bins.residual(), levels, kShown, options.fewest_bins);
    for (std::size_t level = 0; level < levels.count; ++level) {
      Dependence::Branch branch;
      static_cast<Dependence::Curve&>(branch) =
          bins.curve(first, cells, level, cells.count, levels.count);
      branch.second = other->sign ? static_cast<double>(level) - 1.0 : centres[level];
      if (!branch.at.empty()) best->branches.push_back(std::move(branch));
    }
  }
  return best;
}

std::string quantity(const std::string& word, const std::string& variable) {
  return word == "time" ? word : word + " of " + variable;
}

Dependence dependence_of(const Channel& channel, const ChannelBins& bins,
                         const std::vector<const MeasuredVariable*>& variables,
                         const DependenceOptions& options) {
  Dependence best;
  best.channel = channel.name();
  best.unit = channel.unit;
  if (channel.quantity == "orientation") {
    best.channel += std::string("/") + static_cast<char>('x' + channel.component);
  }
  if (!bins.are_enough()) return best;
  const MeasuredVariable* first = nullptr;
  for (const MeasuredVariable* variable : variables) {
    const Steps steps = bins.steps_of(*variable, options.steps);
    const Predicted shares = predicted(bins.residual(), steps, options.fewest_bins);
    best.constant = shares.constant;
    if (shares.steps <= best.share + options.better) continue;
    first = variable;
    best.share = shares.steps;
    best.variable = variable->name;
    best.variable_unit = variable->unit;
    best.word = variable->word;
    best.curve = bins.curve(*variable, steps, 0, steps.count);
  }
  if (best.share > options.telling) {
    best.second = second_of(bins, *first, best.share, variables, options);
  }
  return best;
}

}  // namespace

std::string Dependence::on_what() const {
  const std::string one = quantity(word, variable);
  return second ? one + " and " + quantity(second->word, second->variable) : one;
}

std::vector<Dependence> find_dependences(const Experiments& experiments,
                                         const std::vector<MeasuredVariable>& variables,
                                         const Eigen::VectorXf& residual,
                                         const Eigen::VectorXf& whitener,
                                         const DependenceOptions& options, double block) {
  std::vector<Dependence> found;
  for (const Channel& channel : channels_of(experiments)) {
    found.push_back(dependence_of(
        channel, ChannelBins(experiments, channel, residual, whitener, options, block),
        that_may_explain(channel, variables), options));
  }
  return found;
}

}  // namespace discovery
}  // namespace anthrob
