#pragma once

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <memory>
#include <string>

#include "anthrob_mocap/source/frame_source.h"
#include "anthrob_mocap/source/pairing.h"

namespace anthrob {
namespace mocap {

/// Pairs from two image topics of a bag, as fast as they are taken.
class BagSource final : public FrameSource {
 public:
  /// @param left, right topics
  /// @throws BadInput if there is no such bag or topic
  BagSource(const std::string& file, const std::string& left, const std::string& right,
            double sync_tolerance);

  Grab next(StereoFrame& frame, double timeout) override;

 private:
  std::string file_, topics_[2];
  rosbag::Bag bag_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator position_;
  Pairing pairing_;
  std::uint64_t index_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
