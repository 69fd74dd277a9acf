#include "twin/twins.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_recording/resolution.h"
#include "twin/motion_filter.h"

namespace anthrob {
namespace twin {

namespace {

constexpr int kBlocksBetweenCounts = 10;
constexpr std::size_t kPushSamples = 1000;  // as many as come in a second, and more than wait
constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::min();

std::shared_ptr<const RobotModel> without_chance(const RobotModel& model) {
  auto copy = std::make_shared<RobotModel>(model);
  copy->sensors = model.sensors.predictable();
  return copy;
}

double blended(double from, double to, double share) {
  return from + share * (to - from);
}

}  // namespace

Twins::Twins(const RobotModel& model, const TwinOptions& options, const Floors& floors)
    : model_(without_chance(model)),
      options_(options),
      channels_(model, options),
      measurements_(*model_, options),
      pushes_({}, kPushSamples),
      step_(nanoseconds(model.step)),
      bin_(nanoseconds(options.bin)),
      not_before_(kNever),
      bin_sums_(kFeedCount * channels_.series),
      noise_(kFeedCount * channels_.series, NoiseFloor(options)),
      windows_(kFeedCount * channels_.series, options),
      raw_(channels_.all.size()),
      next_raw_(channels_.all.size(), 0),
      counts_(channels_.all.size(), 0.0) {
  for (const Channel& channel : channels_.all) {
    const auto given = floors.find(channel.name);
    given_.push_back(given == floors.end() ? 0.0 : given->second);
  }
  for (const Feed feed : kFeeds) twins_.emplace_back(model_, feed, options);
  for (auto& values : before_) values.resize(channels_.values);
  for (auto& values : after_) values.resize(channels_.values);
  for (auto& values : raw_) values.reserve(static_cast<std::size_t>(options.raw_values));
  between_.resize(channels_.values);
  inputs_.muscles.resize(model.muscles.size());
  inputs_.q = model.skeleton->rest_configuration();
  inputs_.effort.assign(model.skeleton->joints.size(), kNotMeasured);
  Simulation& sim = twins_.front().sim();
  joint_delay_ = longest_delay_ = nanoseconds(sim.imposed_posture().delay());
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    delays_.push_back(nanoseconds(sim.muscle_inputs().position_delay(m)));
    longest_delay_ = std::max(longest_delay_, delays_.back());
  }
  longest_delay_ += nanoseconds(options.average);
  report_.channels = channels_.all.size();
  report_.floor.assign(report_.channels * kFeedCount, kNotMeasured);
  report_.rms.assign(kWindowCount * report_.channels * kFeedCount, kNotMeasured);
  report_.gap = report_.rms;
  lose_all("nothing was measured yet");
}

void Twins::hear(const MuscleSample& sample) {
  take(measurements_.hear(sample));
}

void Twins::hear(const JointSample& sample, Topic topic) {
  take(measurements_.hear(sample, topic));
}

void Twins::hear(const PushSample& sample) {
  if (!pushes_.holds(sample.stamp)) pushes_.insert(sample);
}

void Twins::take(const std::optional<Break>& broken) {
  if (!broken) return;
  if (broken->of_all) {
    not_before_ = kNever;  // of a time that may have gone back
    pushes_.clear();
    lose_all(broken->why);
  } else {
    lose(Feed::kPostures, broken->why);
  }
}

void Twins::lose(Feed feed, const std::string& why) {
  Status& status = statuses_[static_cast<std::size_t>(feed)];
  status.in_step = status.counts = false;
  status.why = why;
}

void Twins::lose_all(const std::string& why) {
  running_ = false;
  for (const Feed feed : kFeeds) lose(feed, why);
  windows_.clear();
  std::fill(bin_sums_.begin(), bin_sums_.end(), Bin{});
  for (NoiseFloor& noise : noise_) noise.part();
}

std::string Twins::unmeasured(Feed feed) const {
  if (feed == Feed::kCommands || feed == Feed::kVoltages) return {};
  for (std::size_t m = 0; m < model_->muscles.size(); ++m) {
    const MuscleModel& muscle = model_->muscles[m];
    if (muscle.actuator->takes_input() && !measurements_.measured_muscle(m)) {
      return muscle.name + " is not measured";
    }
  }
  if (feed == Feed::kPositions) return {};
  for (const JointModel& joint : model_->skeleton->joints) {
    if (!measurements_.measured_joint(joint)) return joint.name + " is not measured";
  }
  return {};
}

Twins::Place Twins::place(Nanoseconds time) const {
  Place found{model_->skeleton->rest_configuration(), {}, true};
  for (const JointModel& joint : model_->skeleton->joints) {
    const bool measured = measurements_.measured_joint(joint);
    found.all_joints = found.all_joints && measured;
    if (measured) joint_at(measurements_.joints(topic_of(joint)), joint, time, found.q);
  }
  for (std::size_t m = 0; m < model_->muscles.size(); ++m) {
    const double position = position_at(measurements_.muscles(), m, time);
    const double highest = model_->muscles[m].actuator->highest_position();
    found.positions.push_back(std::isfinite(position) ? std::min(position, highest) : 0.0);
  }
  return found;
}

void Twins::start() {
  const auto measured = measurements_.start();
  if (!measured) return;
  Nanoseconds time = *measured;
  if (time < not_before_) {
    if (measurements_.horizon() < not_before_) return;
    const auto& muscles = measurements_.muscles();
    time = muscles.empty() ? not_before_ : muscles[muscles.after(not_before_)].stamp;
  }
  Simulation& sim = twins_.back().sim();
  try {
    const Place there = place(time);
    const Snapshot settled = settle(sim, there.q, there.positions, there.all_joints, options_);
    for (Twin& twin : twins_) twin.start(settled);
  } catch (const std::runtime_error& failure) {
    not_before_ = time + nanoseconds(options_.retry);
    return lose_all(failure.what());
  }
  running_ = true;
  now_ = time;
  bin_end_ = now_ + bin_;
  bins_ = 0;
  measurements_.forget_before(now_, now_ - nanoseconds(options_.average));
  for (const Feed feed : kFeeds) {
    const auto f = static_cast<std::size_t>(feed);
    statuses_[f] = {true, false, statuses_[f].why, statuses_[f].starts + 1};
    counts_from_[f] = now_ + nanoseconds(options_.settle);
    retry_[f] = now_;
    twins_[f].read(channels_, after_[f]);
  }
  begin_inputs();
}

void Twins::start(Feed feed) {
  const auto f = static_cast<std::size_t>(feed);
  try {
    const Place there = place(now_);
    Simulation& sim = twins_[f].sim();
    twins_[f].start(settle(sim, there.q, there.positions, there.all_joints, options_));
  } catch (const std::runtime_error& failure) {
    retry_[f] = now_ + nanoseconds(options_.retry);
    return lose(feed, failure.what());
  }
  statuses_[f] = {true, false, statuses_[f].why, statuses_[f].starts + 1};
  counts_from_[f] = now_ + nanoseconds(options_.settle);
  twins_[f].read(channels_, after_[f]);
}

void Twins::watch_feeds() {
  for (const Feed feed : kFeeds) {
    const auto f = static_cast<std::size_t>(feed);
    Status& status = statuses_[f];
    std::string why = unmeasured(feed);
    if (!why.empty()) {
      lose(feed, why);
    } else if (!status.in_step && now_ >= retry_[f]) {
      start(feed);
    }
    status.counts = status.in_step && now_ >= counts_from_[f];
  }
}

void Twins::begin_inputs() {
  const Place there = place(now_);
  inputs_.q = there.q;
  for (std::size_t m = 0; m < inputs_.muscles.size(); ++m) {
    inputs_.muscles[m].to = there.positions[m];
  }
}

void Twins::find_inputs() {
  const Nanoseconds next = now_ + step_;
  const auto& timeline = measurements_.muscles();
  for (std::size_t m = 0; m < inputs_.muscles.size(); ++m) {
    StepInputs::OfMuscle& input = inputs_.muscles[m];
    input.position = position_at(timeline, m, now_);
    input.from = input.to;
    input.to = std::min(smooth_position(timeline, m, now_ + delays_[m], step_, options_.smooth,
                                        nanoseconds(options_.average), input.from),
                        model_->muscles[m].actuator->highest_position());
    // A measurement shows what was in force up to it.
    const MuscleReading& reading = timeline[timeline.after(next)].muscles[m];
    if (reading.enabled != input.enabled) {
      // When exactly is not known.
      for (const Feed feed : {Feed::kCommands, Feed::kVoltages}) {
        Nanoseconds& from = counts_from_[static_cast<std::size_t>(feed)];
        from = std::max(from, now_ + nanoseconds(options_.settle));
      }
    }
    input.enabled = reading.enabled;
    input.mode = reading.mode;
    input.reference = reading.reference;
    const auto [last, coming, share] = timeline.between(next);
    input.voltage = blended(last.muscles[m].voltage, coming.muscles[m].voltage, share);
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    if (!measurements_.measured_joint(joint)) continue;
    smooth_joint(measurements_.joints(topic_of(joint)), joint, now_ + joint_delay_, step_,
                 options_.smooth, inputs_.q);
  }
  inputs_.pushes.clear();
  pushes_.forget_before(now_);
  if (!pushes_.empty() && pushes_[0].stamp <= now_) {
    for (const PushSample::Push& push : pushes_[0].pushes) {
      if (push.end > now_) inputs_.pushes.push_back(push.wrench);
    }
  }
  const auto& joints = measurements_.joints(Topic::kJoints);
  if (!joints.empty()) inputs_.effort = joints[joints.after(next)].effort;
}

bool Twins::advance() {
  if (!running_) start();
  while (running_ && now_ + step_ + longest_delay_ <= measurements_.horizon()) {
    step();
    if (now_ < bin_end_) continue;
    bin_end_ += bin_;
    close_bin();
    if (++bins_ < options_.bins_in_block) continue;
    bins_ = 0;
    close_block();
    return true;
  }
  return false;
}

void Twins::step() {
  watch_feeds();
  find_inputs();
  for (Twin& twin : twins_) {
    const auto f = static_cast<std::size_t>(twin.feed());
    if (!statuses_[f].in_step) continue;
    std::swap(before_[f], after_[f]);
    try {
      twin.step(inputs_);
    } catch (const std::runtime_error& failure) {
      retry_[f] = now_ + nanoseconds(options_.retry);
      lose(twin.feed(), failure.what());
      continue;
    }
    twin.read(channels_, after_[f]);
  }
  const Nanoseconds next = now_ + step_;
  const auto share_of = [&](Nanoseconds stamp) {
    return static_cast<double>(stamp - now_) / static_cast<double>(step_);
  };
  const auto& muscles = measurements_.muscles();
  for (std::size_t i = 0; i < muscles.size() && muscles[i].stamp <= next; ++i) {
    if (muscles[i].stamp <= now_) continue;
    compare(share_of(muscles[i].stamp), &muscles[i], nullptr, Topic::kMuscles);
  }
  for (const Topic topic : {Topic::kJoints, Topic::kBallJoints}) {
    const auto& joints = measurements_.joints(topic);
    for (std::size_t i = 0; i < joints.size() && joints[i].stamp <= next; ++i) {
      if (joints[i].stamp <= now_) continue;
      compare(share_of(joints[i].stamp), nullptr, &joints[i], topic);
    }
  }
  now_ = next;
  measurements_.forget_before(now_, now_ - nanoseconds(options_.average));
}

void Twins::values_at(std::size_t feed, double share) {
  for (std::size_t i = 0; i < between_.size(); ++i) {
    between_[i] = blended(before_[feed][i], after_[feed][i], share);
  }
  for (const Channel& channel : channels_.all) {
    if (channel.quantity != Quantity::kRotation) continue;
    Eigen::Map<Eigen::Vector4d> turn(&between_[channel.value]);
    const Eigen::Map<Eigen::Vector4d> from(&before_[feed][channel.value]),
        to(&after_[feed][channel.value]);
    if (from.dot(to) < 0.0) turn = (share - 1.0) * from + share * to;
    turn.normalize();
  }
}

void Twins::compare(double share, const MuscleSample* muscles, const JointSample* joints,
                    Topic topic) {
  for (std::size_t f = 0; f < kFeedCount; ++f) {
    if (!statuses_[f].counts) continue;
    values_at(f, share);
    for (const Channel& channel : channels_.all) {
      if (channel.topic != topic || !channel.told[f]) continue;
      double result[3];
      if (muscles != nullptr) {
        difference(channel, *muscles, between_, result);
      } else {
        const auto& joint = model_->skeleton->joints[static_cast<std::size_t>(channel.index)];
        difference(channel, joint, *joints, between_, result);
      }
      add(channel, f, result);
    }
  }
  for (std::size_t c = 0; c < channels_.all.size(); ++c) {
    const Channel& channel = channels_.all[c];
    if (channel.topic != topic || channel.quantity == Quantity::kRotation) continue;
    double value = 0.0;
    if (muscles == nullptr) {
      const auto& joint = model_->skeleton->joints[static_cast<std::size_t>(channel.index)];
      value = joints->q[static_cast<std::size_t>(joint.position_offset)];
    } else {
      const MuscleReading& reading = muscles->muscles[static_cast<std::size_t>(channel.index)];
      value = channel.quantity == Quantity::kForce      ? reading.force
              : channel.quantity == Quantity::kPosition ? reading.position
                                                        : reading.current;
    }
    if (raw_[c].size() < raw_[c].capacity()) {
      raw_[c].push_back(value);
    } else {
      raw_[c][next_raw_[c]] = value;
      next_raw_[c] = (next_raw_[c] + 1) % raw_[c].size();
    }
  }
}

void Twins::add(const Channel& channel, std::size_t feed, const double* difference) {
  for (int k = 0; k < channel.components; ++k) {
    if (!std::isfinite(difference[k])) continue;
    Bin& bin = bin_sums_[series_of(feed, channel.series + static_cast<std::size_t>(k))];
    bin.sum += difference[k];
    bin.count += 1.0;
  }
}

void Twins::close_bin() {
  for (std::size_t s = 0; s < bin_sums_.size(); ++s) {
    const double mean =
        bin_sums_[s].count > 0.0 ? bin_sums_[s].sum / bin_sums_[s].count : kNotMeasured;
    noise_[s].add(mean);
    windows_.add(s, mean);
    bin_sums_[s] = {};
  }
}

double Twins::floor_of(std::size_t c, std::size_t feed) const {
  if (given_[c] > 0.0) return given_[c];
  const Channel& channel = channels_.all[c];
  double squares = 0.0;
  for (int k = 0; k < channel.components; ++k) {
    const double sigma =
        noise_[series_of(feed, channel.series + static_cast<std::size_t>(k))].sigma();
    squares += sigma * sigma;
  }
  const double noise = std::sqrt(squares / channel.components);
  if (!std::isfinite(noise)) return noise;
  return std::max({noise, channel.least, counts_[c]});
}

void Twins::find_counts() {
  for (std::size_t c = 0; c < raw_.size(); ++c) {
    counts_[c] = std::max(counts_[c], resolution_of(raw_[c]) / std::sqrt(12.0));
  }
}

void Twins::close_block() {
  if (blocks_++ % kBlocksBetweenCounts == 0) find_counts();
  windows_.close_block();
  for (NoiseFloor& noise : noise_) noise.update();
  report_.stamp = now_;
  for (std::size_t c = 0; c < channels_.all.size(); ++c) {
    const Channel& channel = channels_.all[c];
    for (const Feed feed : kFeeds) {
      const auto f = static_cast<std::size_t>(feed);
      const double floor = channel.told[f] ? floor_of(c, f) : kNotMeasured;
      report_.floor[report_.floor_at(c, feed)] = floor;
      for (int w = 0; w < kWindowCount; ++w) {
        GapWindows::Sum sum;
        for (int k = 0; k < channel.components; ++k) {
          const auto one =
              windows_.sum(series_of(f, channel.series + static_cast<std::size_t>(k)), w);
          sum.squares += one.squares;
          sum.count += one.count;
        }
        const bool told = channel.told[f] && sum.count >= channel.components * windows_.least(w);
        const double rms = told ? std::sqrt(sum.squares / sum.count) : kNotMeasured;
        report_.rms[report_.at(w, c, feed)] = rms;
        report_.gap[report_.at(w, c, feed)] = rms / floor;
      }
    }
  }
}

}  // namespace twin
}  // namespace anthrob
