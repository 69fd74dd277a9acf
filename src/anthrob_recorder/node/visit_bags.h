#pragma once

#include <ros/time.h>
#include <std_msgs/Header.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bag_file.h"
#include "recording_store.h"

namespace anthrob {

/// The bags of one visit, recorded one after the other. Either all are kept or none.
class VisitBags {
 public:
  /// @param store must outlive the bags   @param model its muscles and joints must be measured
  /// @param prefix of the topics, "/anthrob/"
  VisitBags(const RecordingStore& store, std::shared_ptr<const RobotModel> model,
            const std::string& prefix)
      : store_(store), model_(std::move(model)), prefix_(prefix) {}

  /// Begins a visit whose recordings have these names.
  void begin(const std::vector<std::string>& names);
  const std::vector<std::string>& names() const { return names_; }
  /// From now on messages go into this recording, counted from 1; 0: into none.
  void record(int recording, const ros::Time& now);
  bool recording() const { return recording_ > 0; }

  /// Whether a message belongs to the running recording. Decided by its stamp, not by its arrival:
  /// topics overtake each other, so a late message would be in one run's recording and not in the
  /// next one's.
  bool belongs(const std_msgs::Header& header) const {
    return recording() && header.stamp > since_;
  }
  /// Writes the message if it belongs to the running recording.
  template <class Message>
  void write(const std::string& topic, const Message& message) {
    if (belongs(message.header)) current().write(topic, message);
  }
  /// Writes a message that is sent now, even if its stamp is the instant when the recording begins.
  template <class Message>
  void write_sent(const std::string& topic, const Message& message) {
    if (recording()) current().write(topic, message);
  }
  /// Notes that these muscles or joints were measured at the header's time.
  void see(const std::vector<std::string>& names, const std_msgs::Header& header);

  /// Longest time that anything was not measured in a recording [s].
  /// @param recording as in record
  double largest_gap(int recording) const { return bag(recording).gaps.largest(); }
  /// What was not measured for too long, and for how long; none if nothing.
  std::optional<std::string> trouble() const;

  /// @throws std::runtime_error, for example if the disk is full
  void close();
  /// To be called after close(), once the store has taken the bags over.
  void release();
  /// Deletes all bags of the visit.
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
  ros::Time since_;  ///< the running recording holds what is later
};

}  // namespace anthrob
