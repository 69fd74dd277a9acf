#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "twin/samples.h"
#include "twin/timeline.h"
#include "twin/twin_options.h"

namespace anthrob {
namespace twin {

/// How messages of a topic came.
struct Arrivals {
  long heard = 0;       ///< taken
  long late = 0;        ///< older than what was simulated already
  long repeated = 0;    ///< of an instant that is known
  long incomplete = 0;  ///< without something that was measured before
};

/// A gap, a jump, or time that went back: what was measured of the topic before is forgotten.
struct Break {
  std::string why;  ///< "no muscle_states for 0.5 s"
  bool of_all;      ///< not only of what its topic drives: the robot is not where it was
};

/// What was measured and is still to be simulated: samples in order, whatever the order in which
/// they came, and what breaks the measurement.
class Measurements {
 public:
  /// @param model must outlive it
  Measurements(const RobotModel& model, const TwinOptions& options);

  /// @return what lies between this sample and those before, if they do not lead to it
  std::optional<Break> hear(const MuscleSample& sample);
  std::optional<Break> hear(const JointSample& sample, Topic topic);

  /// From where on the measurement is whole; none while topics are still awaited.
  std::optional<Nanoseconds> start() const;
  /// Up to where all topics that are alive were measured. Of what has started.
  Nanoseconds horizon() const;
  /// Whether a topic is needed, and not far behind the others.
  bool alive(Topic topic) const;
  bool needed(Topic topic) const { return needed_[static_cast<std::size_t>(topic)]; }

  /// What was simulated: older messages are late.
  void forget_before(Nanoseconds simulated, Nanoseconds time);

  const Timeline<MuscleSample>& muscles() const { return muscles_; }
  const Timeline<JointSample>& joints(Topic topic) const {
    return topic == Topic::kJoints ? joints_ : balls_;
  }
  const Arrivals& arrivals(Topic topic) const { return arrivals_[static_cast<std::size_t>(topic)]; }

  /// Whether a muscle's position is measured now, or all numbers of a joint's.
  bool measured_muscle(std::size_t muscle) const;
  bool measured_joint(const JointModel& joint) const;

 private:
  template <class Sample>
  std::optional<Break> hear(const Sample& sample, Topic topic, Timeline<Sample>& timeline);
  /// What is not measured in `sample` but was in the one before; empty: nothing.
  std::string missing(const MuscleSample& before, const MuscleSample& sample) const;
  std::string missing(const JointSample& before, const JointSample& sample) const;
  /// What moved between two samples as nothing can; empty: nothing.
  std::string jumped(const MuscleSample& before, const MuscleSample& sample) const;
  std::string jumped(const JointSample& before, const JointSample& sample) const;
  double farthest(double speed, double other, double time) const;
  void forget_all();
  std::optional<Nanoseconds> newest(Topic topic) const;
  std::optional<Nanoseconds> newest() const;

  const RobotModel& model_;
  TwinOptions options_;
  Timeline<MuscleSample> muscles_;
  Timeline<JointSample> joints_, balls_;
  std::array<bool, kTopicCount> needed_ = {};
  std::array<Arrivals, kTopicCount> arrivals_ = {};
  std::array<int, kTopicCount> late_in_row_ = {};
  std::array<Nanoseconds, kTopicCount> since_ = {};  ///< first sample after a break
  std::optional<Nanoseconds> simulated_;             ///< up to where
};

}  // namespace twin
}  // namespace anthrob
