#include "conclusion/withheld.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "anthrob_core/text.h"

namespace anthrob {
namespace discovery {

namespace {

/// Root mean square by channel, over bins in which a driven joint surely moves [floors].
std::map<std::string, double> rms_in_motion(const Experiments& experiments,
                                            const Eigen::VectorXf& residual) {
  std::map<std::string, std::pair<double, double>> sums;  // squares, bins
  std::size_t offset = 0;
  for (const auto& experiment : experiments) {
    for (const Channel& channel : experiment->channels()) {
      auto& [squares, bins] = sums[channel.name()];
      for (std::size_t b = channel.offset; b < channel.offset + channel.count; ++b) {
        if (!experiment->telling()[b]) continue;
        const double value = residual[static_cast<Eigen::Index>(offset + b)];
        squares += value * value;
        bins += 1.0;
      }
    }
    offset += experiment->size();
  }
  std::map<std::string, double> rms;
  for (const auto& [name, sum] : sums) {
    if (sum.second > 0.0) rms[name] = std::sqrt(sum.first / sum.second);
  }
  return rms;
}

/// The residual in floors, without what correlation took off.
Eigen::VectorXf in_floors(const Judge& judge, const Scales& scales,
                          const Eigen::VectorXf& residual) {
  std::map<std::string, double> factors;
  for (const auto& [name, scale] : scales) factors[name] = std::sqrt(scale.inflation);
  return residual.cwiseProduct(judge.by_channel(factors, 1.0));
}

std::string name_of(const NamedEffect& named) {
  return named.found.id + " @ " + named.found.place;
}

/// The channel in which everything that was named, or nothing, leaves least, if that is too little.
std::string fits_too_well(const Hypotheses& hypotheses, const Scales& scales,
                          const SearchResult& found) {
  const auto residual = in_floors(hypotheses.train_judge, scales, found.extended.fit.residual);
  for (const auto& [name, left] : rms_in_motion(hypotheses.train.experiments(), residual)) {
    if (left >= hypotheses.options.conclusion.least_left) continue;
    const std::string with =
        found.named.empty() ? "" : "with " + name_of(found.named.front()) + ", ";
    return name + ": " + with + "only " + short_number(left) +
           " floors are left, less than noise leaves: these recordings cannot tell what is missing";
  }
  return {};
}

/// Largest effort of a named effect in any channel [floors]; infinite: the model without it cannot
/// be simulated.
double effort_of(const Hypotheses& hypotheses, const Scales& scales, const SearchResult& found,
                 std::size_t effect) {
  const Fitted& fit = found.extended.fit;
  Variant without = fit.variant;
  without.effects[effect] = hypotheses.candidates[found.named[effect].candidate].neutral();
  const Eigen::VectorXf residual = hypotheses.train.residual(without);
  if (residual.size() == 0) return HUGE_VAL;
  const Eigen::VectorXf change = in_floors(hypotheses.train_judge, scales, residual - fit.residual);
  double most = 0.0;
  for (const auto& [name, rms] : rms_in_motion(hypotheses.train.experiments(), change)) {
    most = std::max(most, rms);
  }
  return most;
}

SearchResult without_any(SearchResult found) {
  found.extended = found.recalibrated;
  found.named.clear();
  found.record.alternatives.clear();
  return found;
}

/// Nothing if the model cannot do without it.
std::optional<SearchResult> without(const Hypotheses& hypotheses, std::size_t effect,
                                    SearchResult found) {
  if (found.named.size() == 1) return without_any(std::move(found));
  auto fit = hypotheses.without(effect, found.named[effect].candidate, found.extended.fit);
  if (!fit) return std::nullopt;
  found.extended = hypotheses.tested(std::move(*fit));
  found.named.erase(found.named.begin() + static_cast<std::ptrdiff_t>(effect));
  found.record.alternatives.clear();
  return found;
}

}  // namespace

SearchResult withhold(const Hypotheses& hypotheses, const Scales& scales, SearchResult found) {
  if (!hypotheses.evaluator.model()->muscles.empty()) return found;
  const double least = hypotheses.options.conclusion.least_effort;
  for (std::size_t e = found.named.size(); e-- > 0;) {
    const double effort = effort_of(hypotheses, scales, found, e);
    if (effort >= least) continue;
    const std::string reason = name_of(found.named[e]) + ": its effort is " + short_number(effort) +
                               " floors: these recordings cannot tell whether it is there";
    if (auto rest = without(hypotheses, e, found)) {
      found = std::move(*rest);
      found.record.withheld.push_back(reason);
    }
  }
  const std::string too_well = fits_too_well(hypotheses, scales, found);
  if (too_well.empty()) return found;
  found = without_any(std::move(found));
  found.record.withheld.push_back(too_well);
  return found;
}

}  // namespace discovery
}  // namespace anthrob
