#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <functional>
#include <memory>
#include <string>

#include "source/frame_source.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// Pairs from two image topics of a bag, as fast as the caller takes them.
class BagSource final : public FrameSource {
 public:
  using Refuse = std::function<void(const std::string& why)>;

  /// @param left, right topics
  /// @param refuse gets a message for each image that cannot be used, and at the end one for images
  ///   without a partner, if they are many
  /// @throws BadInput if there is no such bag or topic
  BagSource(const std::string& file, const std::string& left, const std::string& right,
            double sync_tolerance, Refuse refuse);

  /// @throws BadInput at the end of a bag without a pair, or if it is damaged
  Grab next(StereoFrame& frame, double timeout) override;
  Pairing::Counts take_counts() override;

 private:
  void open();
  Grab next_pair(StereoFrame& frame);

  std::string file_, topics_[2];
  rosbag::Bag bag_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator position_;
  Pairing pairing_;
  Pairing::Counts total_;  ///< of what take_counts has taken
  Refuse refuse_;
  std::string last_refusal_;
  bool ended_ = false;
  std::uint64_t index_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
