#include "bag_source.h"

#include <sstream>
#include <stdexcept>

#include "anthrob_core/errors.h"
#include "conversions.h"

namespace anthrob {
namespace mocap {

namespace {

/// What rosbag throws does not name the file.
template <class Read>
auto reading(const std::string& file, const Read& read) {
  try {
    return read();
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw BadInput(file + ": cannot be read as a bag (" + error.what() + ")");
  }
}

}  // namespace

BagSource::BagSource(const std::string& file, const std::string& left, const std::string& right,
                     double sync_tolerance, Refuse refuse)
    : file_(file), topics_{left, right}, pairing_(sync_tolerance), refuse_(std::move(refuse)) {
  reading(file_, [&] { open(); });
}

void BagSource::open() {
  bag_.open(file_, rosbag::bagmode::Read);
  view_ = std::make_unique<rosbag::View>(
      bag_, rosbag::TopicQuery(std::vector<std::string>{topics_[kLeft], topics_[kRight]}));
  for (const std::string& topic : topics_) {
    rosbag::View one(bag_, rosbag::TopicQuery(topic));
    if (one.size() == 0) throw BadInput(file_ + ": no images on topic " + topic);
  }
  position_ = view_->begin();
}

FrameSource::Grab BagSource::next(StereoFrame& frame, double) {
  return reading(file_, [&] { return next_pair(frame); });
}

FrameSource::Grab BagSource::next_pair(StereoFrame& frame) {
  for (; position_ != view_->end(); ++position_) {
    const sensor_msgs::ImageConstPtr message = position_->instantiate<sensor_msgs::Image>();
    if (!message)
      throw BadInput(file_ + ": " + position_->getTopic() + ": expected sensor_msgs/Image");
    const Side side = position_->getTopic() == topics_[kLeft] ? kLeft : kRight;
    TimedImage pair[2];
    try {
      if (!pairing_.add(side, timed_image(message), pair)) continue;
    } catch (const BadInput& error) {
      std::ostringstream text;
      text << file_ << ": " << topics_[side] << ": image stamped " << message->header.stamp
           << " s: " << error.what();
      refuse_(last_refusal_ = text.str());
      continue;
    }
    for (const Side s : {kLeft, kRight}) {
      frame.image[s] = pair[s].image;
      frame.owner[s] = pair[s].owner;
    }
    frame.t = pair[kLeft].t;
    frame.ns = pair[kLeft].ns;
    frame.index = index_++;
    ++position_;
    return Grab::kFrame;
  }
  if (ended_) return Grab::kEnd;
  ended_ = true;
  pairing_.end();
  take_counts();
  if (index_ == 0) {
    const auto why = Pairing::complaint(total_, pairing_.tolerance());
    throw BadInput(last_refusal_.empty() ? file_ + ": " + why.value() : last_refusal_);
  }
  if (const auto loss = Pairing::loss(total_)) refuse_(file_ + ": " + *loss);
  return Grab::kEnd;
}

Pairing::Counts BagSource::take_counts() {
  const Pairing::Counts counts = pairing_.take_counts();
  for (const Side side : {kLeft, kRight}) total_.images[side] += counts.images[side];
  total_.pairs += counts.pairs;
  total_.lost += counts.lost;
  if (counts.nearest != 0.0) total_.nearest = counts.nearest;
  return counts;
}

}  // namespace mocap
}  // namespace anthrob
