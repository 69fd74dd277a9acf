#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "twin/channels.h"
#include "twin/gap_windows.h"
#include "twin/given_floors.h"
#include "twin/measurements.h"
#include "twin/noise_floor.h"
#include "twin/twin.h"
#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

/// Where robot and model part. Lists by window, channel and feed: see `at`.
struct GapReport {
  Nanoseconds stamp = 0;      ///< end of the windows
  std::vector<double> floor;  ///< by channel and feed; NaN: not learned yet
  std::vector<double> rms;    ///< of measured minus twin; NaN: not told
  std::vector<double> gap;    ///< rms over floor
  std::size_t channels = 0;

  std::size_t floor_at(std::size_t channel, Feed feed) const {
    return channel * kFeedCount + static_cast<std::size_t>(feed);
  }
  std::size_t at(int window, std::size_t channel, Feed feed) const {
    return static_cast<std::size_t>(window) * channels * kFeedCount + floor_at(channel, feed);
  }
};

/// Four copies of the model beside a robot, each fed with less or more of what is measured, in step
/// with the stamps of the measurement. A function of the samples in the order in which they are
/// heard: same samples, same bits. Does not allocate while stepping.
class Twins {
 public:
  /// @param model its noise and counts are left out: they are the floor
  /// @param floors of channels whose floor is not to be learned
  Twins(const RobotModel& model, const TwinOptions& options, const Floors& floors = {});

  void hear(const MuscleSample& sample);
  void hear(const JointSample& sample, Topic topic);
  /// Nobody waits for these: a robot that is not pushed has none.
  void hear(const PushSample& sample);
  /// Steps as far as all was measured, but not beyond the end of a block.
  /// @return whether a block ended: report() is new, and there may be more to step
  bool advance();

  const RobotModel& model() const { return *model_; }
  std::shared_ptr<const RobotModel> shared_model() const { return model_; }
  const Channels& channels() const { return channels_; }
  const Measurements& measurements() const { return measurements_; }
  const Simulation& sim(Feed feed) const { return twins_[static_cast<std::size_t>(feed)].sim(); }
  const GapReport& report() const { return report_; }

  struct Status {
    bool in_step = false;
    bool counts = false;  ///< has settled
    std::string why;      ///< it is not in step, or was not before its last start
    long starts = 0;
  };
  const Status& status(Feed feed) const { return statuses_[static_cast<std::size_t>(feed)]; }
  /// Instant of the twins; none while they are lost.
  std::optional<Nanoseconds> time() const {
    return running_ ? std::make_optional(now_) : std::nullopt;
  }

 private:
  struct Bin {
    double sum = 0.0, count = 0.0;
  };

  void take(const std::optional<Break>& broken);
  void lose(Feed feed, const std::string& why);
  void lose_all(const std::string& why);
  void start();
  void start(Feed feed);
  /// What keeps a feed from being imposed; empty: nothing.
  std::string unmeasured(Feed feed) const;
  /// Where the robot was measured, at rest where it was not.
  struct Place {
    std::vector<double> q, positions;
    bool all_joints;
  };
  Place place(Nanoseconds time) const;
  void watch_feeds();
  void begin_inputs();
  void find_inputs();
  void step();
  void compare(double step_share, const MuscleSample* muscles, const JointSample* joints,
               Topic topic);
  void values_at(std::size_t feed, double share);
  void add(const Channel& channel, std::size_t feed, const double* difference);
  void close_bin();
  void close_block();
  void find_counts();
  double floor_of(std::size_t channel, std::size_t feed) const;
  std::size_t series_of(std::size_t feed, std::size_t series) const {
    return feed * channels_.series + series;
  }

  std::shared_ptr<const RobotModel> model_;
  TwinOptions options_;
  Channels channels_;
  Measurements measurements_;
  Timeline<PushSample> pushes_;
  std::deque<Twin> twins_;  ///< by feed; they cannot be moved
  std::array<Status, kFeedCount> statuses_;
  std::array<Nanoseconds, kFeedCount> counts_from_ = {}, retry_ = {};
  std::vector<Nanoseconds> delays_;  ///< of muscles' position sensors
  Nanoseconds joint_delay_, longest_delay_, step_, bin_;

  bool running_ = false;
  Nanoseconds now_ = 0, bin_end_ = 0, not_before_;
  int bins_ = 0;  ///< of the block
  StepInputs inputs_;
  std::array<std::vector<double>, kFeedCount> before_, after_;  ///< values, around the last step
  std::vector<double> between_;

  std::vector<Bin> bin_sums_;             ///< by series_of()
  std::vector<NoiseFloor> noise_;         ///< the same
  GapWindows windows_;                    ///< the same
  std::vector<std::vector<double>> raw_;  ///< last measured values, by channel
  std::vector<std::size_t> next_raw_;
  std::vector<double> counts_;  ///< error of counts that were found, by channel
  std::vector<double> given_;   ///< floors, by channel; 0: to be learned
  int blocks_ = 0;
  GapReport report_;
};

}  // namespace twin
}  // namespace anthrob
