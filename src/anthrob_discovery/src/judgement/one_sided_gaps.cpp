#include "judgement/one_sided_gaps.h"

#include "anthrob_core/text.h"

namespace anthrob {
namespace discovery {

std::vector<OneSidedGap> one_sided_gaps(const Judge& train, const Eigen::VectorXf& learned,
                                        const Judge& test, const Eigen::VectorXf& held_out) {
  const JudgementOptions& options = train.options();
  const auto gaps = train.channel_gaps(learned);
  const auto sure = train.excess_significance(learned, options.certain_gap),
             sure_of_held_out = test.excess_significance(held_out, options.certain_gap);
  const auto is_certain = [&](const std::map<std::string, double>& significance,
                              const std::string& channel) {
    const auto found = significance.find(channel);
    return found != significance.end() && found->second > options.sure;
  };
  std::vector<OneSidedGap> one_sided;
  for (const auto& [channel, other] : test.channel_gaps(held_out)) {
    const auto found = gaps.find(channel);
    if (found == gaps.end()) continue;
    const double own = found->second;
    if ((own <= options.real_gap && is_certain(sure_of_held_out, channel)) ||
        (other <= options.real_gap && is_certain(sure, channel))) {
      one_sided.push_back({channel, own, other});
    }
  }
  return one_sided;
}

std::string remark_on(const OneSidedGap& gap) {
  return gap.channel + ": gap of " + short_number(gap.learned) +
         " floors in the --train recordings and of " + short_number(gap.held_out) +
         " in the --test recordings: what is learned from the ones does not hold in the others; "
         "something changed between them, or ordinary parameters stand in for what is missing";
}

}  // namespace discovery
}  // namespace anthrob
