#pragma once

#include <string>
#include <vector>

#include "judgement/judge.h"

namespace anthrob {
namespace discovery {

/// A channel with a certain gap only in the recordings that were fitted, or only in those that were
/// held out: what was learned from the ones does not hold in the others.
struct OneSidedGap {
  std::string channel;                   ///< "<place>/<channel>"
  double learned = 0.0, held_out = 0.0;  ///< gaps [floors]
};

/// @param learned, held_out residuals of one model in the recordings of the two judges
/// @return channels that both measure, with no gap on one side and one above two floors, by three
/// standard errors over blocks, on the other
std::vector<OneSidedGap> one_sided_gaps(const Judge& train, const Eigen::VectorXf& learned,
                                        const Judge& test, const Eigen::VectorXf& held_out);

/// Says so, for people.
std::string remark_on(const OneSidedGap& gap);

}  // namespace discovery
}  // namespace anthrob
