#pragma once

#include <rosbag/bag.h>

#include <memory>
#include <string>

#include "gap_watch.h"

namespace anthrob {

/// A bag that is being written. Messages are stored at their own stamps, so that the same run gives
/// the same bag.
class BagFile {
 public:
  /// @param prefix of the topics, "/anthrob/"
  /// @throws std::runtime_error if the file cannot be created
  BagFile(const std::string& file, const std::string& prefix);
  /// Abandons a bag that was not closed, without an error.
  ~BagFile();
  BagFile(const BagFile&) = delete;
  BagFile& operator=(const BagFile&) = delete;

  template <class Message>
  void write(const std::string& topic, const Message& message) {
    // A bag cannot hold time 0.
    const ros::Time stamp = std::max(message.header.stamp, ros::TIME_MIN);
    try {
      bag_->write(prefix_ + topic, stamp, message);
    } catch (const rosbag::BagException& error) {
      fail(error);
    }
  }
  /// @throws std::runtime_error, as write does, for example if the disk is full
  void close();

  GapWatch gaps;  ///< in the measurements while the bag is written

 private:
  void abandon();
  [[noreturn]] void fail(const rosbag::BagException& error) const;

  std::string file_;

  std::unique_ptr<rosbag::Bag> bag_;  ///< null after it failed to close
  std::string prefix_;
};

}  // namespace anthrob
