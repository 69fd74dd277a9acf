#include "anthrob_control/robot_state.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace anthrob {

namespace {

/// What clocks of two computers, or of two topics, may differ [s].
constexpr double kAhead = 0.5;
/// Faster than any joint of an arm moves [rad/s or m/s], and what may be noise besides [rad or m].
constexpr double kFastest = 30.0, kNoise = 0.05;
/// How long a joint that jumped must stay where it then is [s]: less than the motors go on without
/// a command.
constexpr double kSettled = 0.2;
constexpr double kNever = -std::numeric_limits<double>::infinity();

/// A clock that is ahead must not make old measurements young: what counts is the older of stamp
/// and receipt.
std::optional<std::string> check_age(const std::string& who, double stamp, double receipt,
                                     double now, double stale_after) {
  if (stamp == kNever) return who + ": not measured yet";
  const bool from_ahead = now - stamp < -std::max(stale_after, kAhead);
  const double age = now - (from_ahead ? stamp : std::min(stamp, receipt));
  if (age <= stale_after && !from_ahead) return std::nullopt;
  char text[32];
  std::snprintf(text, sizeof(text), "%.3f", std::abs(age));
  return who + ": the last measurement is " + text +
         (from_ahead ? " s in the future: clocks differ, or time was set back" : " s old");
}

/// [rad or m] between positions of a joint.
double distance(JointType type, const double* one, const double* other) {
  if (type != JointType::kBall) return std::abs(one[0] - other[0]);
  return Quat(one[0], one[1], one[2], one[3])
      .angularDistance(Quat(other[0], other[1], other[2], other[3]));
}

double reach(double time) {
  return kFastest * std::max(0.0, time) + kNoise;
}

std::string jump_text(double jump, double time, const char* unit) {
  char text[160];
  std::snprintf(text, sizeof(text),
                "jumped by %.3g %s in %.3g s, faster than a joint moves: a loose encoder, or two "
                "nodes that publish it?",
                jump, unit, time);
  return text;
}

}  // namespace

RobotState::RobotState(std::shared_ptr<const RobotModel> model) : model_(std::move(model)) {
  clear();
}

void RobotState::clear() {
  measured_.q = model_->skeleton->rest_configuration();
  measured_.u = Eigen::VectorXd::Zero(model_->skeleton->velocity_count);
  measured_.muscles.assign(model_->muscles.size(), {});
  for (std::size_t m = 0; m < measured_.muscles.size(); ++m) {
    // May never be measured, and zero would be a value.
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (!must_be_measured(m)) measured_.muscles[m] = {nan, nan, nan, nan};
  }
  muscle_stamps_.assign(model_->muscles.size(), kNever);
  joint_stamps_.assign(model_->skeleton->joints.size(), kNever);
  muscle_receipts_ = muscle_stamps_;
  joint_receipts_ = joint_stamps_;
  taken_ = joint_stamps_;
  jumps_.assign(joint_stamps_.size(), std::nullopt);
  jumped_ = false;
  enabled_.assign(model_->muscles.size(), 0);
  mode_.assign(model_->muscles.size(), std::nullopt);
  was_disabled_.reset();
}

void RobotState::see_muscle(const std::string& name, const ecu::Measurement& m, bool enabled,
                            double stamp) {
  const int index = model_->find_muscle(name);
  if (index < 0) return;
  if (!std::isfinite(m.position + m.velocity + m.current) || std::isinf(m.force)) return;
  if (!was_disabled_ && !enabled && model_->muscles[index].has_controller) {
    was_disabled_ = static_cast<std::size_t>(index);
  }
  measured_.muscles[index] = m;
  enabled_[index] = enabled;
  muscle_stamps_[index] = stamp;
  muscle_receipts_[index] = received_;
}

void RobotState::see_mode(const std::string& name, ecu::Mode mode) {
  const int index = model_->find_muscle(name);
  if (index >= 0) mode_[index] = mode;
}

/// As last measured [rad/s or m/s].
double RobotState::speed_of(std::size_t joint) const {
  const JointModel& model = model_->skeleton->joints[joint];
  return measured_.u.segment(model.velocity_offset, model.type == JointType::kBall ? 3 : 1).norm();
}

bool RobotState::is_reachable(std::size_t joint, const double* q, double stamp) {
  const JointModel& model = model_->skeleton->joints[joint];
  const double* last = &measured_.q[model.position_offset];
  const double jump = distance(model.type, q, last), time = stamp - taken_[joint];
  std::optional<Jump>& pending = jumps_[joint];
  // From a jump it comes back to where it would be by now, not to anywhere.
  const double near = pending ? reach(stamp - pending->last) + speed_of(joint) * time : reach(time);
  if (taken_[joint] == kNever || jump <= near) {
    pending.reset();
    return true;
  }
  if (!pending || distance(model.type, q, pending->q.data()) > reach(stamp - pending->last)) {
    const char* unit = model.type == JointType::kPrismatic ? "m" : "rad";
    pending = Jump{{}, stamp, stamp, jump_text(jump, time, unit)};
  }
  std::copy(q, q + (model.type == JointType::kBall ? 4 : 1), pending->q.begin());
  pending->last = stamp;
  if (stamp - pending->begin < kSettled) return false;
  pending.reset();
  jumped_ = true;
  return true;
}

void RobotState::see_joint(const std::string& name, double position, double velocity,
                           double stamp) {
  const int index = model_->skeleton->find_joint(name);
  if (index < 0 || !std::isfinite(position + velocity)) return;
  const JointModel& joint = model_->skeleton->joints[index];
  if (joint.type == JointType::kBall) return;
  const auto j = static_cast<std::size_t>(index);
  const bool taken = is_reachable(j, &position, stamp);
  joint_stamps_[j] = stamp;
  joint_receipts_[j] = received_;
  if (!taken) return;
  taken_[j] = stamp;
  measured_.q[joint.position_offset] = position;
  measured_.u[joint.velocity_offset] = velocity;
}

void RobotState::see_ball_joint(const std::string& name, const Quat& orientation,
                                const Vec3& velocity, double stamp) {
  const int index = model_->skeleton->find_joint(name);
  if (index < 0) return;
  const JointModel& joint = model_->skeleton->joints[index];
  if (joint.type != JointType::kBall) return;
  if (!velocity.allFinite() || !(std::abs(orientation.norm() - 1.0) < 1e-3)) return;
  const Quat unit = canonical(orientation.normalized());
  const std::array<double, 4> q = {unit.w(), unit.x(), unit.y(), unit.z()};
  const auto j = static_cast<std::size_t>(index);
  const bool taken = is_reachable(j, q.data(), stamp);
  joint_stamps_[j] = stamp;
  joint_receipts_[j] = received_;
  if (!taken) return;
  taken_[j] = stamp;
  std::copy(q.begin(), q.end(), &measured_.q[joint.position_offset]);
  measured_.u.segment<3>(joint.velocity_offset) = velocity;
}

bool RobotState::must_be_measured(std::size_t muscle) const {
  return model_->muscles[muscle].actuator->takes_input();
}

std::optional<std::string> RobotState::complaint(double now, double stale_after) const {
  for (std::size_t j = 0; j < joint_stamps_.size(); ++j) {
    if (auto why = check_age("joint " + model_->skeleton->joints[j].name, joint_stamps_[j],
                             joint_receipts_[j], now, stale_after)) {
      return why;
    }
    if (jumps_[j]) return "joint " + model_->skeleton->joints[j].name + ": " + jumps_[j]->text;
  }
  return complaint_of_muscles(now, stale_after);
}

std::optional<std::string> RobotState::complaint_of_muscles(double now, double stale_after) const {
  for (std::size_t m = 0; m < muscle_stamps_.size(); ++m) {
    if (!must_be_measured(m)) continue;
    if (auto why = check_age("muscle " + model_->muscles[m].name, muscle_stamps_[m],
                             muscle_receipts_[m], now, stale_after)) {
      return why;
    }
  }
  return std::nullopt;
}

bool RobotState::complete_since(double stamp) const {
  for (std::size_t m = 0; m < muscle_stamps_.size(); ++m) {
    if (must_be_measured(m) && !(muscle_stamps_[m] >= stamp)) return false;
  }
  return std::all_of(joint_stamps_.begin(), joint_stamps_.end(),
                     [stamp](double seen) { return seen >= stamp; });
}

std::optional<std::string> RobotState::disabled_muscle() const {
  for (std::size_t m = 0; m < enabled_.size(); ++m) {
    if (model_->muscles[m].has_controller && !enabled_[m]) return model_->muscles[m].name;
  }
  return std::nullopt;
}

std::optional<std::string> RobotState::muscle_not_in(ecu::Mode mode) const {
  for (std::size_t m = 0; m < enabled_.size(); ++m) {
    const bool other = mode_[m] && *mode_[m] != mode;
    if (model_->muscles[m].has_controller && enabled_[m] && other) return model_->muscles[m].name;
  }
  return std::nullopt;
}

std::optional<std::string> RobotState::muscle_without_force() const {
  for (std::size_t m = 0; m < enabled_.size(); ++m) {
    if (model_->muscles[m].has_controller && std::isnan(measured_.muscles[m].force)) {
      return model_->muscles[m].name;
    }
  }
  return std::nullopt;
}

bool RobotState::take_jump() {
  return std::exchange(jumped_, false);
}

std::optional<std::string> RobotState::take_disabled() {
  const std::optional<std::size_t> muscle = std::exchange(was_disabled_, std::nullopt);
  if (!muscle) return std::nullopt;
  return model_->muscles[*muscle].name;
}

}  // namespace anthrob
