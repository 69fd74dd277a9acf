#pragma once

#include <ros/time.h>
#include <std_msgs/Header.h>

#include <memory>
#include <string>
#include <vector>

#include "anthrob_record/recording_store.h"
#include "bag_file.h"

namespace anthrob {

/// The bags of one visit, recorded one after the other: all are kept, or none.
class VisitBags {
 public:
  /// @param store must outlive the bags   @param model what there is to be measured
  /// @param prefix of the topics, "/anthrob/"
  VisitBags(const RecordingStore& store, std::shared_ptr<const RobotModel> model,
            const std::string& prefix)
      : store_(store), model_(std::move(model)), prefix_(prefix) {}

  /// A visit begins whose recordings have these names.
  void begin(const std::vector<std::string>& names);
  const std::vector<std::string>& names() const { return names_; }
  /// From now on messages go into this recording, the first being 1; 0: into none.
  void record(int recording, const ros::Time& now);
  bool recording() const { return recording_ > 0; }

  /// Whether a message is of the recording that runs. Not by its arrival: topics overtake each
  /// other, and a straggler of the instant before would be in one recording and not in the next.
  bool belongs(const std_msgs::Header& header) const {
    return recording() && header.stamp > since_;
  }
  /// Nothing if it does not belong.
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    if (belongs(message.header)) current().write(topic, message);
  }
  /// What is sent just now, at the instant the recording begins too.
  template <class Message>
  void write_sent(const std::string& topic, const Message& message) {
    if (recording()) current().write(topic, message);
  }
  /// These were measured, at the header's time.
  void see(const std::vector<std::string>& names, const std_msgs::Header& header);

  /// [s] that something was not measured in a recording. @param recording as in record
  double largest_gap(int recording) const { return bag(recording).gaps.largest(); }
  /// What was not measured for too long; empty: nothing.
  std::string trouble() const;

  /// @throws rosbag::BagException, if the disk is full, say
  void close();
  /// After close(), once the store has taken them over.
  void release();
  /// None of them is kept.
  void discard();

 private:
  BagFile& bag(int recording) const { return *bags_[static_cast<std::size_t>(recording - 1)]; }
  BagFile& current() { return bag(recording_); }

  const RecordingStore& store_;
  std::shared_ptr<const RobotModel> model_;
  std::string prefix_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<BagFile>> bags_;  ///< null before they are recorded
  int recording_ = 0;
  ros::Time since_;  ///< what the recording that runs begins after
};

}  // namespace anthrob
