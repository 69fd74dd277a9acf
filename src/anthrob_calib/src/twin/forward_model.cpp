#include "twin/forward_model.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"

namespace anthrob {
namespace twin {

namespace {

/// Something that has limits, and what was seen of it.
struct Watched {
  Crossing crossing;
  double low, high;
  std::function<double()> value;
  bool crossed = false;

  void look(double time) {
    const double now = value();
    if (now >= low && now <= high) return;
    const double limit = now > high ? high : low;
    if (!crossed) crossing.time = time;
    if (!crossed || std::abs(now - limit) > std::abs(crossing.value - crossing.limit)) {
      crossing.value = now, crossing.limit = limit;
    }
    crossed = true;
  }
};

/// Rotation of a ball joint from rest [rad].
double turn_of(const double* wxyz) {
  const double vector = std::hypot(wxyz[1], wxyz[2], wxyz[3]);
  return 2.0 * std::atan2(vector, std::abs(wxyz[0]));
}

std::vector<Watched> watched_in(const Simulation& sim) {
  std::vector<Watched> all;
  for (const JointModel& joint : sim.model().skeleton->joints) {
    if (!joint.stop.enabled) continue;
    const auto at = static_cast<std::size_t>(joint.position_offset);
    const bool ball = joint.type == JointType::kBall;
    const char* const unit = joint.type == JointType::kPrismatic ? "m" : "rad";
    all.push_back({{joint.name, ball ? "rotation" : "position", unit},
                   ball ? 0.0 : joint.stop.lower,
                   joint.stop.upper,
                   [&sim, at, ball] {
                     const double* const q = sim.configuration().data() + at;
                     return ball ? turn_of(q) : *q;
                   }});
  }
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    const MuscleModel& muscle = sim.muscle(m).model();
    if (!muscle.has_controller || muscle.limits.force <= 0.0) continue;
    all.push_back({{muscle.name, "force", "N"}, -HUGE_VAL, muscle.limits.force, [&sim, m] {
                     return sim.muscle(m).measured().force;
                   }});
  }
  return all;
}

void give(const Outlook& outlook, Simulation& sim) {
  for (const Order& order : outlook.orders) {
    sim.command(order.muscle, order.mode, order.reference);
  }
  for (int m = 0; outlook.enable && m < static_cast<int>(sim.muscle_count()); ++m) {
    if (sim.muscle(m).model().has_controller) sim.muscle_inputs().set_enabled(m, true);
  }
}

}  // namespace

std::string Crossing::text() const {
  return place + ": " + quantity + " of " + significant(value, 3) + " " + unit + ", beyond " +
         significant(limit, 3) + " " + unit + " from " + significant(time, 2) + " s on";
}

std::unique_ptr<Simulation> present(const Twins& twins) {
  const Twins::Status& commands = twins.status(Feed::kCommands);
  if (!twins.time() || !commands.in_step) {
    throw BadInput("the twin has lost the robot: " + commands.why);
  }
  // Of what is measured, motors and joints are where they are in the robot.
  const bool measured = twins.status(Feed::kPostures).in_step;
  const Simulation& commanded = twins.sim(Feed::kCommands);
  auto sim = std::make_unique<Simulation>(twins.shared_model());
  sim->restore((measured ? twins.sim(Feed::kPostures) : commanded).snapshot());
  sim->imposed_posture().release();
  for (int m = 0; m < static_cast<int>(sim->muscle_count()); ++m) {
    sim->muscle_inputs().release(m);
    if (!sim->muscle(m).model().has_controller) continue;
    const Muscle& own = commanded.muscle(m);
    sim->muscle_inputs().set_enabled(m, own.enabled());
    if (std::isfinite(own.reference())) sim->command(m, own.mode(), own.reference());
  }
  return sim;
}

std::vector<Crossing> run_ahead(Simulation& sim, const Outlook& outlook,
                                const std::function<void(double)>& see) {
  give(outlook, sim);
  std::vector<Watched> watched = watched_in(sim);
  const auto steps = std::lround(outlook.duration / sim.step_length());
  const long every = outlook.rate > 0.0
                         ? std::max(1L, std::lround(1.0 / (outlook.rate * sim.step_length())))
                         : std::max(1L, steps);
  for (long i = 1; i <= steps; ++i) {
    sim.step();
    const double time = static_cast<double>(i) * sim.step_length();
    for (Watched& one : watched) one.look(time);
    if (i % every == 0 || i == steps) see(time);
  }
  std::vector<Crossing> crossings;
  for (const Watched& one : watched) {
    if (one.crossed) crossings.push_back(one.crossing);
  }
  std::stable_sort(crossings.begin(), crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.time < b.time; });
  return crossings;
}

}  // namespace twin
}  // namespace anthrob
