#include "health/protocol.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {
namespace health {

namespace {

constexpr double kDegreesOf = 180.0 / M_PI;
constexpr double kCommandStep = 0.005;  // [s] between two commands of a replay
constexpr double kLowestTension = 1.0;  // [N] of a level that tells anything
constexpr double kSlideAsTurn = 10.0;   // [rad/m]
const char* const kPostureKey = "health_test_posture";
constexpr int kTurns = 3;                         // an error needs three
const double kLevels[] = {0.25, 0.5, 0.75, 1.0};  // of the highest

bool is_tested(const MuscleModel& muscle) {
  return muscle.has_controller && !muscle.is_drive() && muscle.motor() != nullptr &&
         muscle.has_force_sensor() && muscle.controller.position.proportional > 0.0;
}

/// Tensions of the tested tendons that balance each other and gravity; nothing else is counted on.
struct TensionLevel {
  Eigen::VectorXd tension;    ///< by muscle [N]
  Eigen::VectorXd shortfall;  ///< [Nm, N]
};

/// @param sim in the posture
TensionLevel level_of(const Simulation& sim, double lowest_tension, const HealthOptions& options) {
  const auto count = static_cast<Eigen::Index>(sim.muscle_count());
  Eigen::VectorXd low = Eigen::VectorXd::Zero(count), high = low;
  for (Eigen::Index m = 0; m < count; ++m) {
    const Muscle& muscle = sim.muscle(static_cast<int>(m));
    if (is_tested(muscle.model())) {
      low[m] = lowest_tension, high[m] = 10.0 * options.highest_tension;
    } else if (!muscle.model().is_drive() && !muscle.model().actuator->takes_input()) {
      low[m] = high[m] = muscle.model().spring->relaxed_tension(muscle.expansion());
    }
  }
  const LeastEffort split = least_effort(moment_arm_matrix(sim), holding_load(sim), low, high);
  return {split.tension, split.shortfall};
}

/// Whether all tensions of a level balance, within what a muscle may have.
bool is_balanced(const RobotModel& model, const TensionLevel& level, const HealthOptions& options) {
  if (level.shortfall.size() > 0 && level.shortfall.cwiseAbs().maxCoeff() > options.unbalanced) {
    return false;
  }
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    if (!is_tested(model.muscles[m])) continue;
    const double most =
        std::min(options.highest_tension, options.share_of_force * model.muscles[m].limits.force);
    if (level.tension[static_cast<Eigen::Index>(m)] > most) return false;
  }
  return true;
}

/// The highest common tension that balances [N]; 0: none.
double highest_level(const Simulation& sim, const HealthOptions& options) {
  const auto balances = [&](double tension) {
    return is_balanced(sim.model(), level_of(sim, tension, options), options);
  };
  if (!balances(kLowestTension)) return 0.0;
  double low = kLowestTension, high = options.highest_tension;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (balances(middle) ? low : high) = middle;
  }
  return low;
}

/// Let go, an arm that does not hang would fall.
void require_hanging(const Simulation& sim, const HealthOptions& options) {
  const Eigen::VectorXd load = holding_load(sim);
  for (const JointModel& joint : sim.model().skeleton->joints) {
    const int axes = joint.type == JointType::kBall ? 3 : 1;
    const double own = load.segment(joint.velocity_offset, axes).norm();
    if (own <= options.hanging) continue;
    throw BadInput(sim.model().file + ": " + joint.name + " needs " + significant(own, 2) +
                   " Nm to be held in this posture; expected an arm that hangs at rest");
  }
}

}  // namespace

TestProtocol::TestProtocol(const std::shared_ptr<const RobotModel>& model,
                           const std::vector<double>& q, const HealthOptions& options)
    : model_(model), options_(options), posture_(q) {
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    if (is_tested(model->muscles[m])) muscles_.push_back(static_cast<int>(m));
  }
  if (muscles_.empty()) {
    throw BadInput(model->file +
                   ": no tendon has a force sensor and a motor under position control");
  }
  Simulation sim(model);
  sim.place(q, std::vector<double>(sim.muscle_count(), 0.0));
  require_hanging(sim, options);
  const double highest = highest_level(sim, options);
  if (!(highest > kLowestTension)) {
    throw BadInput(model->file +
                   ": in this posture, tensions cannot balance each other and gravity; expected an "
                   "arm that hangs at rest");
  }
  const auto references_of = [&](double tension, double let_out) {
    const TensionLevel level = level_of(sim, tension, options);
    std::vector<double> references;
    for (const int m : muscles_) {
      const MuscleModel& muscle = model->muscles[static_cast<std::size_t>(m)];
      const double reference =
          position_reference(muscle, sim.muscle(m).length(), level.tension[m]) - let_out;
      if (std::abs(reference) > muscle.limits.position) {
        throw BadInput(model->file + ": " + muscle.name + ": the test would need a reference of " +
                       significant(reference, 3) + " rad; expected at most limits.position, " +
                       significant(muscle.limits.position, 3));
      }
      references.push_back(reference);
    }
    return references;
  };
  const auto slack = references_of(kLowestTension, options.slack);
  const auto low = references_of(0.5 * highest, 0.0), high = references_of(highest, 0.0);
  const TensionLevel top = level_of(sim, highest, options),
                     between = level_of(sim, 0.75 * highest, options);
  for (const int m : muscles_) {
    const MuscleModel& muscle = model->muscles[static_cast<std::size_t>(m)];
    const double tension = between.tension[m];
    const double stretched =
        muscle.spring->rest_length() + muscle.spring->relaxed_expansion(tension);
    middle_tension_.push_back(tension);
    middle_winding_.push_back(muscle.motor()->spindle_radius() *
                              muscle.actuator->position_for(sim.muscle(m).length() - stretched));
    highest_tension_.push_back(top.tension[m]);
    moment_arms_.push_back(sim.moment_arms(m));
  }
  using Kind = Phase::Kind;
  knots_ = {{0.0, slack}};
  go_to(slack, 6.0, Kind::kSlack);
  double t = 6.0;
  for (const double level : kLevels) {
    const auto reference = references_of(level * highest, 0.0);
    go_to(reference, t + 1.0, Kind::kMove);
    go_to(reference, t + 4.0, Kind::kLevel);
    t += 4.0;
  }
  for (int turn = 0; turn < kTurns; ++turn) {
    go_to(low, t + 3.4, Kind::kFlank);
    go_to(high, t + 6.8, Kind::kFlank);
    t += 6.8;
  }
  go_to(low, t + 1.0, Kind::kMove);
  go_to(low, t + 3.0, Kind::kMove);
  go_to(high, t + 3.5, Kind::kMove);
  go_to(high, t + 16.5, Kind::kHold);
  go_to(slack, t + 18.0, Kind::kMove);
}

void TestProtocol::go_to(const std::vector<double>& reference, double until, Phase::Kind kind) {
  phases_.push_back({kind, knots_.back().time, until});
  knots_.push_back({until, reference});
}

const Phase& TestProtocol::phase_at(double time) const {
  for (const Phase& phase : phases_) {
    if (time < phase.end) return phase;
  }
  return phases_.back();
}

const char* TestProtocol::words(Phase::Kind kind) {
  switch (kind) {
    case Phase::Kind::kMove:
      return "on the way";
    case Phase::Kind::kSlack:
      return "slack";
    case Phase::Kind::kLevel:
      return "tension in steps";
    case Phase::Kind::kFlank:
      return "slow reversal";
    case Phase::Kind::kHold:
      break;
  }
  return "hold";
}

std::vector<double> TestProtocol::references(double time) const {
  std::size_t next = 1;
  while (next + 1 < knots_.size() && time >= knots_[next].time) ++next;
  const Knot &a = knots_[next - 1], &b = knots_[next];
  const double share = std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0);
  std::vector<double> references;
  for (std::size_t i = 0; i < a.reference.size(); ++i) {
    references.push_back(a.reference[i] + share * (b.reference[i] - a.reference[i]));
  }
  return references;
}

Dataset TestProtocol::commands() const {
  Dataset data;
  data.meta.robot = model_->name;
  data.meta.start = "zero";
  note_posture(data);
  Table& table = data.table("commands");
  const auto mode = static_cast<double>(ecu::Mode::kPosition);
  for (const int m : muscles_) {
    const std::string& name = model_->muscles[static_cast<std::size_t>(m)].name;
    table.column(name + "/mode"), table.column(name + "/reference");
  }
  for (double time = 0.0; time < duration(); time += kCommandStep) {
    table.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * time)));
    const std::vector<double> now = references(time);
    for (std::size_t i = 0; i < now.size(); ++i) {
      for (const auto& [at, value] : {std::pair{2 * i, mode}, std::pair{2 * i + 1, now[i]}}) {
        table.columns[at].values.push_back(value), table.columns[at].present.push_back(1);
      }
    }
  }
  return data;
}

void TestProtocol::note_posture(Dataset& recording) const {
  std::string text;
  for (const double value : posture_) text += (text.empty() ? "[" : ", ") + exact_text(value);
  recording.meta.other[kPostureKey] = text + "]\n";
}

std::vector<double> posture_of(const std::shared_ptr<const RobotModel>& model,
                               const Dataset& recording) {
  std::vector<double> rest = Simulation(model).configuration();
  const auto noted = recording.meta.other.find(kPostureKey);
  if (noted == recording.meta.other.end()) return rest;
  std::vector<double> posture;
  std::istringstream stream(trimmed(noted->second, " \t\r\n[]"));
  std::string number;
  while (std::getline(stream, number, ',')) {
    char* end = nullptr;
    posture.push_back(std::strtod(number.c_str(), &end));
    if (end == number.c_str() || !std::isfinite(posture.back())) posture.clear();
  }
  if (posture.size() == rest.size()) return posture;
  throw BadInput(recording.folder + ": meta.yaml: " + kPostureKey + ": expected " +
                 std::to_string(rest.size()) + " numbers, the posture of the model's joints");
}

std::optional<std::string> moved_too_far(const RobotModel& model, const std::vector<double>& from,
                                         const std::vector<double>& now, double largest) {
  for (const JointModel& joint : model.skeleton->joints) {
    const auto at = static_cast<std::size_t>(joint.position_offset);
    double turn = std::abs(now[at] - from[at]);
    if (joint.type == JointType::kPrismatic) turn *= kSlideAsTurn;
    if (joint.type == JointType::kBall) {
      double same = 0.0;
      for (std::size_t k = 0; k < 4; ++k) same += from[at + k] * now[at + k];
      turn = 2.0 * std::acos(std::min(1.0, std::abs(same)));
    }
    if (turn > largest) return joint.name + ": " + significant(kDegreesOf * turn, 2) + " degrees";
  }
  return {};
}

}  // namespace health
}  // namespace anthrob
