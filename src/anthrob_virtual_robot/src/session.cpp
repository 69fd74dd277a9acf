#include "session.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace anthrob::virtual_robot {
namespace {

constexpr double kLead = 0.5;        // at the first posture [s]
constexpr double kMove = 4.0;        // until all has settled, the ring's relaxation with it [s]
constexpr double kRest = 5.0;        // before a recording [s]
constexpr double kSearchRest = 2.0;  // the same, where nothing is recorded [s]
constexpr double kGain = 0.8;        // of a correction
constexpr double kFarthest = 0.4;    // a correction in all [rad]

Eigen::Vector3d vector_of(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q);
  return turn.angle() * turn.axis();
}

Eigen::Quaterniond quaternion(const ConfigNode& node) {
  const std::vector<ConfigNode> items = node.items();
  if (items.size() != 4) node.fail_expected("a quaternion [w, x, y, z]");
  double q[4];
  for (int k = 0; k < 4; ++k) {
    q[k] = items[static_cast<std::size_t>(k)].as_number(Bounds::between(-1.0, 1.0), "1");
  }
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}

void run_for(Robot* robot, double seconds) {
  const auto ticks = std::lround(seconds / robot->period());
  for (long k = 0; k < ticks; ++k) robot->tick();
}

RecordingSettings settings_of_recordings() {
  RecordingSettings settings;
  settings.settle = kRest;
  return settings;
}

}  // namespace

std::vector<Target> load_targets(const std::string& file, double lowest_tension) {
  const ConfigNode node = ConfigNode::load(file);
  std::vector<Target> targets;
  for (const ConfigNode& posture : node.at("postures").items()) {
    Target target;
    target.name = posture.text("name");
    target.pose.shoulder = vector_of(quaternion(posture.at("joints").at("shoulder")));
    target.pose.elbow = posture.at("joints").number_or("elbow", 0.0, Bounds::any(), "rad");
    target.pose.lowest_tension = lowest_tension;
    targets.push_back(target);
  }
  return targets;
}

Session::Session(std::function<Robot(std::uint64_t)> robot,
                 const reference::ArmParameters& believed, const CalibrationRobotSettings& settings,
                 bool has_elbow)
    : robot_(std::move(robot)), reference_(believed), settings_(settings), has_elbow_(has_elbow) {
  for (const auto& muscle : believed.muscles) muscles_.push_back(muscle.name);
}

void Session::find_references(const std::vector<Target>& targets) {
  known_.clear();
  for (const Target& target : targets) {
    Known best{target, {}};
    double least = HUGE_VAL;
    Pose aim = target.pose;
    for (int attempt = 0; attempt < settings_.tries && least > settings_.close; ++attempt) {
      const std::vector<double> references = reference_.positions(aim);
      Robot robot = robot_(0);
      robot.place(known_.empty() ? references : known_.front().references);
      run_for(&robot, kSearchRest);
      robot.command(references);
      run_for(&robot, kMove);
      const Readings& end = robot.truth();
      const Eigen::Vector3d off =
          vector_of(end.shoulder.conjugate() * rotation(target.pose.shoulder));
      const double bend = has_elbow_ ? target.pose.elbow - end.elbow : 0.0;
      const double error = std::hypot(off.norm(), bend);
      if (error < least) least = error, best.references = references;
      aim.shoulder += kGain * off;
      const Eigen::Vector3d moved = aim.shoulder - target.pose.shoulder;
      if (moved.norm() > kFarthest) {
        aim.shoulder = target.pose.shoulder + kFarthest * moved.normalized();
      }
      aim.elbow = std::clamp(aim.elbow + kGain * bend, 0.0, 2.2);
    }
    known_.push_back(best);
  }
}

const Session::Known& Session::known(const std::string& name) const {
  for (const Known& one : known_) {
    if (one.target.name == name) return one;
  }
  throw std::invalid_argument(name + ": no such posture");
}

void Session::record_equilibria(const std::string& folder) {
  for (const Known& one : known_) {
    run({{0.0, known_.front().references}, {kLead, one.references}}, kLead + kMove + kLead,
        "equilibrium", folder + "/" + one.target.name + "_run1");
  }
}

void Session::record_trajectories(const std::vector<std::string>& names,
                                  const std::string& folder) {
  const Known& rest = known_.front();
  for (const Known& one : known_) {
    if (one.target.name == rest.target.name) continue;
    if (!names.empty() && std::find(names.begin(), names.end(), one.target.name) == names.end()) {
      continue;
    }
    const std::string there = rest.target.name + "_to_" + one.target.name + "_run1";
    const std::string back = one.target.name + "_to_" + rest.target.name + "_run1";
    Robot robot = robot_(++runs_);
    const double seconds = kLead + kMove;
    const auto settings = settings_of_recordings();
    write(record(&robot, {{0.0, rest.references}, {kLead, one.references}}, seconds, settings),
          "trajectory", folder + "/" + there);
    write(follow(&robot, {{0.0, one.references}, {kLead, rest.references}}, seconds, settings),
          "trajectory", folder + "/" + back);
  }
}

void Session::record_tour(const std::vector<std::string>& names, double each,
                          const std::string& name, const std::string& folder) {
  std::vector<Command> commands{{0.0, known_.front().references}};
  double t = kLead;
  for (const std::string& posture : names) {
    commands.push_back({t, known(posture).references});
    t += each;
  }
  commands.push_back({t, known_.front().references});
  run(commands, t + kMove, "trajectory", folder + "/" + name);
}

void Session::run(const std::vector<Command>& commands, double seconds, const std::string& kind,
                  const std::string& folder) {
  Robot robot = robot_(++runs_);
  write(record(&robot, commands, seconds, settings_of_recordings()), kind, folder);
}

void Session::write(const Recording& recording, const std::string& kind,
                    const std::string& folder) const {
  Meta meta;
  meta.kind = kind;
  meta.settle = kRest;
  meta.has_elbow = has_elbow_;
  write_dataset(recording, muscles_, settings_of_recordings(), meta, folder);
}

}  // namespace anthrob::virtual_robot
