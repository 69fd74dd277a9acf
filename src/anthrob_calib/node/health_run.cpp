#include "health_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "anthrob_core/progress_lines.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

namespace {

constexpr double kPatience = 30.0;        // [s] of wall time until a robot appears
constexpr double kFresh = 0.1;            // [s] older measurements do not count
constexpr double kSilence = 0.5;          // [s] after which the test ends
constexpr double kLetGo = 0.5;            // [s] in which the tendons are let out again and again
constexpr double kEchoTime = 0.5;         // [s] until a reference that was sent is followed
constexpr double kEchoOff = 0.01;         // [rad] that a unit's arithmetic may add
constexpr int kUnheardPeriods = 60;       // 0.3 s
constexpr double kProgressPeriod = 0.25;  // [s] a reader may be slow
constexpr double kCommandPeriod = 0.02;   // [s]
constexpr int kAwayPeriods = 5;           // 25 ms: noise of a sensor is no motion
constexpr double kRestSpeed = 0.1;        // [rad/s, m/s] of a joint at rest
constexpr double kRestTurn = 0.09;        // [rad, 0.1 m] 5 degrees from rest, at most

/// Adds a row of numbers to a table; messages of one kind have the same names.
void add_row(Table& table, const ros::Time& stamp, const std::vector<std::string>& names,
             const std::vector<double>& values) {
  const auto t = static_cast<Nanoseconds>(stamp.toNSec());
  if (!table.t.empty() && t <= table.t.back()) return;
  const std::size_t rows = table.t.size();
  table.t.push_back(t);
  for (std::size_t i = 0; i < names.size(); ++i) {
    Column& column = table.column(names[i]);
    column.values.resize(rows, NAN), column.present.resize(rows, 0);
    column.values.push_back(values[i]);
    column.present.push_back(std::isfinite(values[i]) ? 1 : 0);
  }
  for (Column& column : table.columns) {
    if (column.values.size() > rows) continue;
    column.values.push_back(NAN), column.present.push_back(0);
  }
}

}  // namespace

HealthRun::HealthRun(ros::NodeHandle nh, std::shared_ptr<const RobotModel> model,
                     const RobotLink::Options& link, const health::HealthOptions& options)
    : model_(std::move(model)),
      options_(options),
      lock_step_(link.lock_step),
      link_(nh, model_, link) {
  recording_.meta.robot = model_->name;
  recording_.meta.start = "first";
  recording_.tables.reserve(4);
  for (const char* name : {"commands", "muscles", "joints", "spherical_joints"}) {
    recording_.table(name);
  }
  link_.on_muscles = [this](const anthrob_msgs::MuscleStates& m) {
    for (const auto* list :
         {&m.position, &m.velocity, &m.current, &m.voltage, &m.force, &m.reference}) {
      if (list->size() != m.name.size()) return;
    }
    for (std::size_t i = 0; i < m.name.size(); ++i) echoed_[m.name[i]] = m.reference[i];
    if (!begin_ || m.header.stamp < *begin_) return;
    std::vector<std::string> names;
    std::vector<double> values;
    for (std::size_t i = 0; i < m.name.size(); ++i) {
      const std::pair<const char*, double> quantities[] = {{"position", m.position[i]},
                                                           {"velocity", m.velocity[i]},
                                                           {"current", m.current[i]},
                                                           {"voltage", m.voltage[i]},
                                                           {"force", m.force[i]}};
      for (const auto& [quantity, value] : quantities) {
        names.push_back(m.name[i] + "/" + quantity), values.push_back(value);
      }
    }
    add_row(recording_.table("muscles"), m.header.stamp, names, values);
  };
  link_.on_joints = [this](const sensor_msgs::JointState& m) {
    if (m.position.size() != m.name.size()) return;
    if (!begin_ || m.header.stamp < *begin_) return;
    std::vector<std::string> names;
    for (const std::string& joint : m.name) names.push_back(joint + "/position");
    add_row(recording_.table("joints"), m.header.stamp, names, m.position);
  };
  link_.on_ball_joints = [this](const anthrob_msgs::SphericalJointStates& m) {
    if (m.orientation.size() != m.name.size()) return;
    if (!begin_ || m.header.stamp < *begin_) return;
    std::vector<std::string> names;
    std::vector<double> values;
    for (std::size_t i = 0; i < m.name.size(); ++i) {
      const auto& q = m.orientation[i];
      const std::pair<const char*, double> numbers[] = {
          {"w", q.w}, {"x", q.x}, {"y", q.y}, {"z", q.z}};
      for (const auto& [number, value] : numbers) {
        names.push_back(m.name[i] + "/" + number), values.push_back(value);
      }
    }
    add_row(recording_.table("spherical_joints"), m.header.stamp, names, values);
  };
}

std::optional<Dataset> HealthRun::run() {
  tool::progress_lines::stage("waiting for the robot");
  if (!wait_for_robot()) return {};
  require_rest();
  posture_ = link_.state().measurement().q;
  protocol_ = std::make_unique<health::TestProtocol>(model_, posture_, options_);
  tool::progress_lines::stage("letting the tendons out");
  if (!let_out() || !follow_protocol()) return {};
  auto& tables = recording_.tables;
  tables.erase(std::remove_if(tables.begin(), tables.end(),
                              [](const Table& table) { return table.t.empty(); }),
               tables.end());
  protocol_->note_posture(recording_);
  return recording_;
}

bool HealthRun::wait_for_robot() {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience);
  while (link_.wait()) {
    const auto silent = link_.state().complaint(link_.now().toSec(), kFresh);
    if (!silent) return true;
    if (ros::WallTime::now() > end) throw std::runtime_error("no robot to test: " + *silent);
  }
  return false;
}

void HealthRun::require_rest() const {
  if (const auto off = link_.state().disabled_muscle()) {
    throw std::runtime_error("the motor of " + *off + " is not enabled; call enable first");
  }
  const RobotMeasurement& now = link_.state().measurement();
  const std::vector<double> rest = Simulation(model_).configuration();
  if (const auto away = health::moved_too_far(*model_, rest, now.q, kRestTurn)) {
    throw std::runtime_error(*away + " from rest; expected an arm that hangs");
  }
  if (now.u.size() > 0 && now.u.cwiseAbs().maxCoeff() > kRestSpeed) {
    throw std::runtime_error("a joint moves; expected an arm that hangs at rest");
  }
}

bool HealthRun::let_out() {
  std::vector<double> from;
  for (const int m : protocol_->muscles()) {
    from.push_back(link_.state().measurement().muscles[static_cast<std::size_t>(m)].position);
  }
  const std::vector<double> slack = protocol_->references(0.0);
  double way = 0.0;
  for (std::size_t i = 0; i < slack.size(); ++i) way = std::max(way, std::abs(slack[i] - from[i]));
  const double duration = way / options_.speed;
  const ros::Time begin = link_.now();
  while (link_.wait()) {
    const double share = duration > 0.0 ? (link_.now() - begin).toSec() / duration : 1.0;
    std::vector<double> now = from;
    for (std::size_t i = 0; i < now.size(); ++i) {
      now[i] += std::min(1.0, share) * (slack[i] - from[i]);
    }
    send(now);
    if (share >= 1.0) return true;
    watch(0.0);
  }
  return false;
}

bool HealthRun::follow_protocol() {
  const double duration = protocol_->duration();
  begin_ = link_.now();
  sent_ = ros::Time();
  send(protocol_->references(0.0));
  std::string stage;
  double told = -kProgressPeriod;
  while (link_.wait()) {
    const double time = (link_.now() - *begin_).toSec();
    if (time >= duration) return true;
    watch(time);
    send(protocol_->references(time));
    if (time < told + kProgressPeriod) continue;
    told = time;
    const std::string now = health::TestProtocol::words(protocol_->phase_at(time).kind);
    if (now != stage) tool::progress_lines::stage(stage = now);
    tool::progress_lines::share(time / duration, duration - time);
  }
  return false;
}

std::optional<std::string> HealthRun::other_reference() {
  const auto is_old = [&](const auto& one) {
    return (link_.now() - one.first).toSec() > kEchoTime;
  };
  while (asked_.size() > 1 && is_old(asked_[1])) asked_.pop_front();
  if (asked_.empty() || !is_old(asked_.front())) return {};
  for (std::size_t i = 0; i < protocol_->muscles().size(); ++i) {
    const std::string& name =
        model_->muscles[static_cast<std::size_t>(protocol_->muscles()[i])].name;
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const auto& [time, references] : asked_) {
      low = std::min(low, references[i]), high = std::max(high, references[i]);
    }
    const double echo = echoed_.count(name) ? echoed_[name] : NAN;
    if (echo >= low - kEchoOff && echo <= high + kEchoOff) continue;
    return name + " follows the reference " + significant(echo, 3) + " rad, not " +
           significant(high, 3) + ": another node commands it, or last_rejection in /diagnostics " +
           "says why it refuses";
  }
  return {};
}

std::optional<std::string> HealthRun::trouble() {
  if (const auto off = link_.take_disabled()) return "the motor of " + *off + " was stopped";
  if (const auto obstacle = link_.obstacle()) return *obstacle;
  const RobotMeasurement& now = link_.state().measurement();
  const auto far = health::moved_too_far(*model_, posture_, now.q, options_.largest_turn);
  away_ = far ? away_ + 1 : 0;
  if (away_ >= kAwayPeriods) return *far + " from where it was";
  for (std::size_t i = 0; i < protocol_->muscles().size(); ++i) {
    const auto m = static_cast<std::size_t>(protocol_->muscles()[i]);
    const double most =
        options_.share_of_level * protocol_->highest_tension()[i] + options_.beside_level;
    const double force = now.muscles[m].force;
    if (force <= most) continue;
    return model_->muscles[m].name + " pulls with " + significant(force, 3) + " N, where at most " +
           significant(protocol_->highest_tension()[i], 3) + " are asked for";
  }
  try {
    reference_watch_.look(link_.state(), link_.now(), lock_step_);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  const auto other = other_reference();
  // Of two nodes that command in turn, each is followed for a while.
  unheard_ = other ? unheard_ + 2 : std::max(0, unheard_ - 1);
  if (unheard_ >= 2 * kUnheardPeriods) return other;
  return {};
}

void HealthRun::watch(double time) {
  const std::string ended = ": the test ended after " + significant(time, 3) + " s";
  // What is not measured gets no command: after its time-out the motors let go.
  if (link_.time_jumped()) throw std::runtime_error("time jumped back" + ended);
  if (const auto silent = link_.state().complaint(link_.now().toSec(), kSilence)) {
    throw std::runtime_error(*silent + ended);
  }
  const auto why = trouble();
  if (!why) return;
  let_go();
  throw std::runtime_error(*why + ended);
}

void HealthRun::let_go() {
  const ros::Time begin = link_.now();
  do {
    sent_ = ros::Time();
    send(protocol_->references(0.0));
  } while (link_.wait() && (link_.now() - begin).toSec() < kLetGo);
}

void HealthRun::send(const std::vector<double>& references) {
  if (!sent_.isZero() && (link_.now() - sent_).toSec() < kCommandPeriod - 1e-6) return;
  anthrob_msgs::MuscleCommand command;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < references.size(); ++i) {
    const auto m = static_cast<std::size_t>(protocol_->muscles()[i]);
    command.name.push_back(model_->muscles[m].name);
    command.mode.push_back(static_cast<std::uint8_t>(ecu::Mode::kPosition));
    command.reference.push_back(references[i]);
    names.push_back(model_->muscles[m].name + "/reference");
  }
  sent_ = link_.send(command);
  asked_.emplace_back(sent_, references);
  if (begin_) add_row(recording_.table("commands"), sent_, names, references);
}

}  // namespace anthrob
