#include "search/gaps.h"

#include <algorithm>

#include "judgement/excess.h"
#include "judgement/merit.h"

namespace anthrob {
namespace discovery {

bool Gaps::any(const Tested& tested, double least) const {
  const auto learned = train_.channel_gaps(tested.fit.residual);
  const auto held_out = test_.channel_gaps(tested.test);
  return std::any_of(held_out.begin(), held_out.end(), [&](const auto& channel) {
    const auto found = learned.find(channel.first);
    return channel.second > least && found != learned.end() && found->second > least;
  });
}

bool Gaps::certain(const Tested& tested) const {
  return certain_gap(train_, tested.fit.residual, test_, tested.test, train_.options().real_gap);
}

double Gaps::excess_of(const Eigen::VectorXf& held_out, double least) const {
  double sum = 0.0;
  for (const auto& [name, gap] : test_.channel_gaps(held_out)) sum += excess(gap, least);
  return sum;
}

Merit Gaps::merit_of(const ShortList& list, const Tested& base) const {
  const FittedCandidate& best = list.entries.front();
  const JudgementOptions& options = test_.options();
  const double before = excess_of(base.test, options.faint_gap),
               first = first_excess(options.faint_gap);
  const double gained = before - excess_of(best.test, options.faint_gap);
  Merit merit;
  merit.probability = best.probability;
  merit.none = list.none;
  merit.learned = base.fit.cost - best.fit.cost;
  merit.evidence = best.evidence;
  merit.needed_evidence = needed_evidence(candidates_, options.merit);
  merit.significance = best.significance;
  merit.only_faint_gaps = !any(base, options.real_gap);
  if (before > 0.0) merit.share = gained / before;
  if (first > 0.0) merit.share_of_first = gained / first;
  return merit;
}

}  // namespace discovery
}  // namespace anthrob
