// Energy audit of the whole chain, from the ECU's output to the bones, over a motion of Anthrob's
// arm.
#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/simulation.h"
#include "support.h"

namespace anthrob {
namespace {

/// Where the energy that the ECUs put in has gone [J].
struct Account {
  double electrical = 0.0, copper = 0.0, gear = 0.0, eyelets = 0.0, rings = 0.0, joints = 0.0;
  double stored = 0.0;
  double turned_over = 0.0;

  double missing() const { return electrical - copper - gear - eyelets - rings - joints - stored; }
};

/// Kinetic energy of motors, magnetic energy, rings, skeleton.
double stored_energy(const Simulation& sim) {
  double sum = audit_energy(sim).kinetic + audit_energy(sim).potential;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const Muscle& muscle = sim.muscle(m);
    const auto& p = static_cast<const DcMotor&>(*muscle.model().actuator).parameters();
    const Actuator::Readout motor = muscle.actuator();
    const double speed = p.ratio * motor.velocity;
    sum += muscle.spring_energy() + 0.5 * p.inductance * motor.current * motor.current +
           0.5 * p.inertia * speed * speed;
  }
  return sum;
}

/// A motion that ends where it began: raise, bend, return.
void command(Simulation& sim, double t) {
  const double lift = t < 3.0 ? 1.0 : 0.0;
  const auto set = [&](const std::string& name, double position) {
    sim.command(sim.model().find_muscle(name), ecu::Mode::kPosition, lift * position);
  };
  set("lateral_deltoid", 6.0);
  set("anterior_deltoid", 1.0);
  set("posterior_deltoid", 1.5);
  set("supraspinatus", 3.0);
  set("biceps_brachii", 4.0);
  set("brachialis", 3.0);
  set("triceps_brachii", -2.0);
}

Account audit(const std::string& model_name, double step) {
  const auto model = load_robot_model(
      testing_support::config("anthrob/model_" + model_name + ".yaml"), {step, {}});
  Simulation sim(model);
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m) {
    sim.command(m, ecu::Mode::kPosition, 0.0);
  }
  Account account;
  const double start = stored_energy(sim);
  std::vector<Actuator::Readout> before(sim.muscle_count());
  std::vector<double> load(sim.muscle_count());
  const int steps = static_cast<int>(std::lround(6.0 / step));
  for (int i = 0; i < steps; ++i) {
    command(sim, sim.time());
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      before[m] = sim.muscle(m).actuator();
      load[m] = sim.muscle(m).tension(0);
    }
    sim.step();
    for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
      const Muscle& muscle = sim.muscle(m);
      const auto& motor = static_cast<const DcMotor&>(*muscle.model().actuator);
      const auto& p = motor.parameters();
      const Actuator::Readout now = muscle.actuator();
      const double current = 0.5 * (before[m].current + now.current);
      const double power = muscle.voltage() * current;
      account.electrical += power * step;
      account.turned_over += std::abs(power) * step;
      account.copper += p.resistance * 0.5 *
                        (before[m].current * before[m].current + now.current * now.current) * step;
      const double torque = load[m] * p.spindle_radius;
      account.gear +=
          (motor.gear()->load(torque, before[m].velocity, before[m].current).torque - torque) *
          (now.position - before[m].position);
      account.eyelets += muscle.friction_power() * step;
      account.rings += muscle.spring_dissipation() * step;
    }
    account.joints += sim.last_step().joint_dissipation * step;
  }
  account.stored = stored_energy(sim) - start;
  return account;
}

TEST(Energy, AuditOfTheWholeChainCloses) {
  for (const char* model : {"I", "II", "III"}) {
    const Account coarse = audit(model, 1e-3), fine = audit(model, 1e-4);
    const double coarse_share = std::abs(coarse.missing()) / coarse.turned_over;
    const double fine_share = std::abs(fine.missing()) / fine.turned_over;
    RecordProperty(std::string("share_1ms_") + model, std::to_string(coarse_share));
    RecordProperty(std::string("share_0.1ms_") + model, std::to_string(fine_share));
    EXPECT_GT(fine.turned_over, 5.0);  // the motion did something
    EXPECT_LT(coarse_share, 1e-2) << model;
    EXPECT_LT(fine_share, 1e-3) << model;
    EXPECT_LT(fine_share, coarse_share) << model;
    // Each sink is one.
    EXPECT_GT(fine.copper, 0.0);
    EXPECT_GT(fine.eyelets, 0.0);
    EXPECT_GT(fine.joints, 0.0);
  }
}

}  // namespace
}  // namespace anthrob
