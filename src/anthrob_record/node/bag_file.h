#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>

#include "anthrob_record/gap_watch.h"

namespace anthrob {

/// A bag while it is written: messages at their own stamps, so that the same run gives the same
/// bag.
class BagFile {
 public:
  /// @param prefix of the topics, "/anthrob/"
  /// @throws std::runtime_error if the file cannot be made
  BagFile(const std::string& file, const std::string& prefix);
  /// Of one that was not closed nobody wants to hear that it cannot be.
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  template <class Message>
  void write(const std::string& topic, const Message& message) {
    // Time 0 cannot be held by a bag.
    const ros::Time stamp = std::max(message.header.stamp, ros::TIME_MIN);
    bag_->write(prefix_ + topic, stamp, message);
  }
  /// @throws rosbag::BagException, if the disk is full, say
  void close();

  GapWatch gaps;  ///< of what is measured while the bag is written

 private:
  void abandon();

  std::unique_ptr<rosbag::Bag> bag_;  ///< null once it could not be closed
  std::string prefix_;
};

}  // namespace anthrob
