#pragma once

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/merit.h"
#include "anthrob_calib/discovery/naming.h"

namespace anthrob {
namespace discovery {

/// The gaps that fits leave, and what an effect does to them.
class Gaps {
 public:
  /// @param train, test judges of what was fitted and of what is held out
  /// @param candidates that were searched
  Gaps(const Judge& train, const Judge& test, std::size_t candidates)
      : train_(train), test_(test), candidates_(candidates) {}

  /// Whether a channel is above a level, in what was learned from and in what was held out.
  bool any(const Tested& tested, double least) const;
  /// The same, and not by chance (certain_gap()).
  bool certain(const Tested& tested) const;
  /// What all channels' squared gaps on held-out data have above a level.
  double excess_of(const Eigen::VectorXf& held_out, double least) const;

  /// Where the search begins: what effects are compared with.
  /// @param held_out residual there
  void begin(const Eigen::VectorXf& held_out) { first_ = held_out; }
  double first_excess(double least) const { return excess_of(first_, least); }

  /// Of the first of a list that was judged against a base.
  Merit merit_of(const ShortList& list, const Tested& base) const;

 private:
  const Judge &train_, &test_;
  std::size_t candidates_;
  Eigen::VectorXf first_;
};

}  // namespace discovery
}  // namespace anthrob
