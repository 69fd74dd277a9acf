#include "health/protocol.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {
namespace health {

namespace {

constexpr double kDegreesOf = 180.0 / M_PI;
constexpr double kCommandStep = 0.005;            // [s] between two commands of a replay
constexpr double kLowestTension = 1.0;            // [N] of a level that tells anything
constexpr double kSlideAsTurn = 10.0;             // [rad/m]
constexpr int kTurns = 3;                         // an error needs three
const double kLevels[] = {0.25, 0.5, 0.75, 1.0};  // of the highest

bool is_tested(const MuscleModel& muscle) {
  return muscle.has_controller && !muscle.is_drive() && muscle.motor() != nullptr &&
         muscle.controller.position.proportional > 0.0;
}

/// Whether all tensions of a level balance, within what a muscle may have.
bool is_balanced(const RobotModel& model, const Equilibrium& level, const HealthOptions& options) {
  if (level.shortfall.size() > 0 && level.shortfall.cwiseAbs().maxCoeff() > options.unbalanced) {
    return false;
  }
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    if (!is_tested(model.muscles[m])) continue;
    const double force = model.muscles[m].limits.force;
    const double most = force > 0.0
                            ? std::min(options.highest_tension, options.share_of_force * force)
                            : options.highest_tension;
    if (level.tension[m] > most) return false;
  }
  return true;
}

/// The highest common tension that balances [N]; 0: none.
double highest_level(Simulation& sim, const std::vector<double>& q, const HealthOptions& options) {
  const auto balances = [&](double tension) {
    EquilibriumOptions level;
    level.lowest_tension = tension;
    level.highest_tension = 10.0 * options.highest_tension;
    return is_balanced(sim.model(), find_equilibrium(sim, q, level), options);
  };
  if (!balances(kLowestTension)) return 0.0;
  double low = kLowestTension, high = options.highest_tension;
  for (int i = 0; i < 20; ++i) {
    const double middle = 0.5 * (low + high);
    (balances(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

TestProtocol::TestProtocol(const std::shared_ptr<const RobotModel>& model,
                           const std::vector<double>& q, const HealthOptions& options)
    : model_(model), options_(options) {
  for (std::size_t m = 0; m < model->muscles.size(); ++m) {
    if (is_tested(model->muscles[m])) muscles_.push_back(static_cast<int>(m));
  }
  if (muscles_.empty()) {
    throw BadInput(model->file + ": no tendon has a motor under position control to test it by");
  }
  Simulation sim(model);
  const double highest = highest_level(sim, q, options);
  if (!(highest > kLowestTension)) {
    throw BadInput(model->file +
                   ": in this posture, tensions cannot balance each other and gravity; expected an "
                   "arm that hangs at rest");
  }
  const auto references_of = [&](double tension, double let_out) {
    EquilibriumOptions level;
    level.lowest_tension = tension;
    level.highest_tension = 10.0 * options.highest_tension;
    const Equilibrium found = find_equilibrium(sim, q, level);
    std::vector<double> references;
    for (const int m : muscles_) {
      references.push_back(found.reference[static_cast<std::size_t>(m)] - let_out);
    }
    return references;
  };
  const auto slack = references_of(kLowestTension, options.slack);
  const auto low = references_of(0.5 * highest, 0.0), high = references_of(highest, 0.0);
  EquilibriumOptions middle;
  middle.lowest_tension = 0.75 * highest;
  middle.highest_tension = 10.0 * options.highest_tension;
  const Equilibrium between = find_equilibrium(sim, q, middle);
  for (const int m : muscles_) {
    const auto i = static_cast<std::size_t>(m);
    middle_tension_.push_back(between.tension[i]);
    middle_winding_.push_back(model->muscles[i].motor()->spindle_radius() * between.position[i]);
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
