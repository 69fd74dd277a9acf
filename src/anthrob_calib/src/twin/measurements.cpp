#include "twin/measurements.h"

#include <cmath>

#include "anthrob_core/text.h"

namespace anthrob {
namespace twin {

namespace {

std::size_t at(Topic topic) {
  return static_cast<std::size_t>(topic);
}

std::size_t capacity_of(const TwinOptions& options) {
  constexpr double kFastestTopic = 1000.0;  // [Hz]
  return static_cast<std::size_t>(options.history * kFastestTopic);
}

Quat turn_of(const std::vector<double>& q, const JointModel& joint) {
  const double* p = &q[static_cast<std::size_t>(joint.position_offset)];
  return {p[0], p[1], p[2], p[3]};
}

double speed_of(const std::vector<double>& velocity, const JointModel& joint) {
  double square = 0.0;
  const double* v = &velocity[static_cast<std::size_t>(joint.velocity_offset)];
  for (int k = 0; k < joint.dof(); ++k) square += v[k] * v[k];
  return std::sqrt(square);
}

bool is_measured(const std::vector<double>& q, const JointModel& joint) {
  bool all = true;
  const double* p = &q[static_cast<std::size_t>(joint.position_offset)];
  for (int k = 0; k < joint.position_size(); ++k) {
    all = all && std::isfinite(p[k]);
  }
  return all;
}

}  // namespace

Measurements::Measurements(const RobotModel& model, const TwinOptions& options)
    : model_(model),
      options_(options),
      muscles_(blank_muscles(model), capacity_of(options)),
      joints_(blank_joints(model), capacity_of(options)),
      balls_(blank_joints(model), capacity_of(options)) {
  needed_[at(Topic::kMuscles)] = !model.muscles.empty();
  for (const JointModel& joint : model.skeleton->joints) needed_[at(topic_of(joint))] = true;
}

std::optional<Break> Measurements::hear(const MuscleSample& sample) {
  return hear(sample, Topic::kMuscles, muscles_);
}

std::optional<Break> Measurements::hear(const JointSample& sample, Topic topic) {
  return hear(sample, topic, topic == Topic::kJoints ? joints_ : balls_);
}

template <class Sample>
std::optional<Break> Measurements::hear(const Sample& sample, Topic topic,
                                        Timeline<Sample>& timeline) {
  const std::size_t t = at(topic);
  Arrivals& arrivals = arrivals_[t];
  std::optional<Break> broken;
  if (!timeline.empty()) {
    const Sample& newest = timeline.newest();
    if (timeline.holds(sample.stamp)) {
      ++arrivals.repeated;
      return std::nullopt;
    }
    const bool late = simulated_ && sample.stamp <= *simulated_;
    // A whole topic may lag behind another: only what comes after a newer one of its own has gone
    // back.
    const bool back = sample.stamp < newest.stamp;
    late_in_row_[t] = late && back ? late_in_row_[t] + 1 : 0;
    if (sample.stamp < newest.stamp - nanoseconds(options_.backwards) ||
        late_in_row_[t] > options_.late_in_row) {
      forget_all();
      broken = Break{"time went back", true};
    } else if (late && back) {
      ++arrivals.late;
      return std::nullopt;
    } else if (!back) {
      arrivals.late += late ? 1 : 0;
      const double gap = seconds(sample.stamp - newest.stamp);
      const std::string absent = missing(newest, sample), jump = jumped(newest, sample);
      if (gap > options_.largest_gap) {
        broken = Break{
            (absent.empty() ? std::string("no ") + kTopicNames[t] : absent + " not measured") +
                " for " + short_number(gap) + " s",
            topic == Topic::kMuscles};
      } else if (!absent.empty()) {
        ++arrivals.incomplete;
        return std::nullopt;
      } else if (!jump.empty()) {
        broken = Break{jump + " jumped", true};
      }
      if (broken) timeline.clear();
    }
  }
  if (timeline.empty()) since_[t] = sample.stamp;
  timeline.insert(sample);
  ++arrivals.heard;
  return broken;
}

std::string Measurements::missing(const MuscleSample& before, const MuscleSample& sample) const {
  for (std::size_t m = 0; m < sample.muscles.size(); ++m) {
    if (std::isfinite(before.muscles[m].position) && !std::isfinite(sample.muscles[m].position)) {
      return model_.muscles[m].name;
    }
  }
  return {};
}

std::string Measurements::missing(const JointSample& before, const JointSample& sample) const {
  for (const JointModel& joint : model_.skeleton->joints) {
    if (is_measured(before.q, joint) && !is_measured(sample.q, joint)) return joint.name;
  }
  return {};
}

double Measurements::farthest(double speed, double other, double time) const {
  double fastest = 0.0;
  for (const double measured : {speed, other}) {
    fastest = std::max(fastest, std::isfinite(measured) ? std::abs(measured) : options_.fastest);
  }
  return options_.least_jump + options_.jump_factor * fastest * time;
}

std::string Measurements::jumped(const MuscleSample& before, const MuscleSample& sample) const {
  const double time = seconds(sample.stamp - before.stamp);
  for (std::size_t m = 0; m < sample.muscles.size(); ++m) {
    const MuscleReading &a = before.muscles[m], &b = sample.muscles[m];
    // Never of what is not measured.
    if (std::abs(b.position - a.position) > farthest(a.velocity, b.velocity, time)) {
      return model_.muscles[m].name;
    }
  }
  return {};
}

std::string Measurements::jumped(const JointSample& before, const JointSample& sample) const {
  const double time = seconds(sample.stamp - before.stamp);
  const auto& joints = model_.skeleton->joints;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto offset = static_cast<std::size_t>(joints[j].position_offset);
    const double distance =
        joints[j].type == JointType::kBall
            ? angular_distance(turn_of(before.q, joints[j]), turn_of(sample.q, joints[j]))
            : std::abs(sample.q[offset] - before.q[offset]);
    const double speed = speed_of(before.velocity, joints[j]);
    if (distance > farthest(speed, speed_of(sample.velocity, joints[j]), time)) {
      return joints[j].name;
    }
  }
  return {};
}

void Measurements::forget_all() {
  muscles_.clear();
  joints_.clear();
  balls_.clear();
  late_in_row_ = {};
  simulated_.reset();
}

void Measurements::forget_before(Nanoseconds simulated, Nanoseconds time) {
  simulated_ = simulated;
  muscles_.forget_before(time);
  joints_.forget_before(time);
  balls_.forget_before(time);
}

std::optional<Nanoseconds> Measurements::newest(Topic topic) const {
  if (topic == Topic::kMuscles) {
    return muscles_.empty() ? std::nullopt : std::make_optional(muscles_.newest().stamp);
  }
  const Timeline<JointSample>& timeline = joints(topic);
  return timeline.empty() ? std::nullopt : std::make_optional(timeline.newest().stamp);
}

std::optional<Nanoseconds> Measurements::newest() const {
  std::optional<Nanoseconds> all;
  for (int t = 0; t < kTopicCount; ++t) {
    const auto one = newest(static_cast<Topic>(t));
    if (needed_[static_cast<std::size_t>(t)] && one && (!all || *one > *all)) all = one;
  }
  return all;
}

bool Measurements::alive(Topic topic) const {
  const auto own = newest(topic), all = newest();
  return needed(topic) && own && *own + nanoseconds(options_.patience) >= *all;
}

std::optional<Nanoseconds> Measurements::start() const {
  const auto all = newest();
  if (!all) return std::nullopt;
  Nanoseconds oldest = *all, latest = 0;
  bool first = true;
  for (int t = 0; t < kTopicCount; ++t) {
    const auto topic = static_cast<Topic>(t);
    if (!newest(topic) || !needed(topic)) continue;
    oldest = std::min(oldest, since_[at(topic)]);
    if (!alive(topic)) continue;
    latest = first ? since_[at(topic)] : std::max(latest, since_[at(topic)]);
    first = false;
  }
  const Topic leading = needed(Topic::kMuscles) ? Topic::kMuscles : Topic::kJoints;
  if (!alive(leading)) return std::nullopt;
  for (int t = 0; t < kTopicCount; ++t) {
    const auto topic = static_cast<Topic>(t);
    if (!needed(topic)) continue;
    const bool awaited = *all - oldest <= nanoseconds(options_.patience);
    if (alive(topic) ? *newest(topic) < latest : awaited) return std::nullopt;
  }
  // Steps are counted from a measurement, so that they meet those that follow.
  if (leading == Topic::kMuscles) latest = muscles_[muscles_.after(latest)].stamp;
  return latest <= horizon() ? std::make_optional(latest) : std::nullopt;
}

Nanoseconds Measurements::horizon() const {
  std::optional<Nanoseconds> all;
  for (int t = 0; t < kTopicCount; ++t) {
    const auto topic = static_cast<Topic>(t);
    if (!alive(topic) && topic != Topic::kMuscles) continue;
    const auto own = newest(topic);
    if (needed(topic) && own && (!all || *own < *all)) all = own;
  }
  return all.value_or(0);
}

bool Measurements::measured_muscle(std::size_t muscle) const {
  return !muscles_.empty() && std::isfinite(muscles_.newest().muscles[muscle].position);
}

bool Measurements::measured_joint(const JointModel& joint) const {
  const Topic topic = topic_of(joint);
  return alive(topic) && is_measured(joints(topic).newest().q, joint);
}

}  // namespace twin
}  // namespace anthrob
