// Effects of which the catalogue says that they dissipate: a robot without supply of energy never
// gains any with them, and more is lost than in the plain model.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "anthrob_sim/actuator/dc_motor.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "effects_support.h"

namespace anthrob {
namespace {

using namespace testing_support;

/// Typical doses, as a multiple: clear, and within the bounds of all these effects.
constexpr double kClear = 3.0;
constexpr double kFineStep = 1e-4;

const char* const kPulley = "two_muscle_rig/model_II.yaml";
constexpr int kWorking = 1;  // the rig's extensor: its spring is linear and hardly damped

/// Friction that goes with the effort of a drive takes nothing where nothing drives: see
/// joint_effects_test.cpp.
const char* const kNeedsADrive = "joint_effort_friction";

std::vector<std::string> dissipating() {
  std::vector<std::string> ids;
  for (const Effect* effect : all_effects()) {
    const EffectInfo& info = effect->info();
    if (info.dissipates && info.id != kNeedsADrive) ids.push_back(info.id);
  }
  return ids;
}

/// A pendulum of 1 kg, 0.3 m below a joint without friction.
class Pendulum {
 public:
  explicit Pendulum(bool ball)
      : ball_(ball),
        robot_(
            std::string("<robot name=\"p\"><link name=\"world\"/><joint name=\"joint\" type=\"") +
                (ball ? "floating" : "continuous") +
                "\"><parent link=\"world\"/><child link=\"bob\"/>" +
                (ball ? "" : "<axis xyz=\"1 0 0\"/>") +
                "</joint><link name=\"bob\"><inertial><origin xyz=\"0 0 -0.3\"/><mass "
                "value=\"1\"/><inertia ixx=\"1e-3\" ixy=\"0\" ixz=\"0\" iyy=\"1e-3\" iyz=\"0\" "
                "izz=\"1e-3\"/></inertial></link></robot>",
            std::string("robot: robot.urdf\ngravity: [0, 0, -9.81]\njoints:\n  joint: ") +
                (ball ? "{type: ball, center: [0, 0, 0]}\n"
                      : "{friction: {static: 0, kinetic: 0, viscous: 0, stribeck_velocity: "
                        "0.05}}\n")) {}

  std::shared_ptr<const RobotModel> load(const std::vector<EffectInstance>& effects) const {
    LoadOptions options;
    options.step = kFineStep;
    options.effects = effects;
    return load_robot_model(robot_.file(), options);
  }
  std::vector<double> tilted(double angle) const {
    if (!ball_) return {angle};
    return {std::cos(0.5 * angle), std::sin(0.5 * angle), 0.0, 0.0};
  }

 private:
  bool ball_;
  TemporaryRobot robot_;
};

/// The rig, with a surface in the way of the flexor over which that slides when the arm swings.
std::shared_ptr<const RobotModel> rig_with(const std::vector<EffectInstance>& effects) {
  static const TemporaryRobot robot("", "extends: " + config(kRig) + R"(
muscles:
  flexor:
    path:
      - {point: [0.03, 0.0, 0.80], body: base}
      - {point: [0.03, 0.0, 0.62], body: base}
      - {cylinder: {origin: [0.01, 0.0, 0.5], axis: [0, 1, 0], radius: 0.025}, body: base}
      - {point: [0.02, 0.0, -0.08], body: arm}
)");
  LoadOptions options;
  options.step = kFineStep;
  options.effects = effects;
  return load_robot_model(robot.file(), options);
}

/// What can give energy back: skeleton, springs, rotors, and fields of windings [J].
/// @param plain the same robot without effects, whose motors tell their inductance
double stored_energy(const Simulation& sim, const RobotModel& plain) {
  double sum = audit_energy(sim).kinetic + audit_energy(sim).potential;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const Muscle& muscle = sim.muscle(static_cast<int>(m));
    const auto& p = static_cast<const DcMotor&>(*plain.muscles[m].actuator).parameters();
    const Actuator::Readout motor = muscle.actuator();
    const double speed = p.ratio * motor.velocity;
    sum += muscle.spring_energy() + 0.5 * p.inductance * motor.current * motor.current +
           0.5 * p.inertia * speed * speed;
  }
  return sum;
}

struct Course {
  double lost = 0.0;    ///< from beginning to end [J]
  double gained = 0.0;  ///< largest rise above what was left before [J]
};

/// Lets a robot go, with no voltage at its motors.
Course let_go(const std::shared_ptr<const RobotModel>& robot, const RobotModel& plain,
              const std::vector<double>& q, const std::vector<double>& positions, double seconds) {
  Simulation sim(robot);
  sim.place(q, positions);
  for (int m = 0; m < static_cast<int>(sim.muscle_count()); ++m)
    sim.muscle_inputs().set_enabled(m, false);
  const double start = stored_energy(sim, plain);
  Course course;
  double least = start;
  for (int i = 0; i < static_cast<int>(std::lround(seconds / sim.step_length())); ++i) {
    sim.step();
    const double energy = stored_energy(sim, plain);
    course.gained = std::max(course.gained, energy - least);
    least = std::min(least, energy);
  }
  course.lost = start - stored_energy(sim, plain);
  return course;
}

/// A place on the robot where the effect's seam works in the benches below.
std::string place_of(const Effect& effect, const RobotModel& robot) {
  const auto places = effect.places(robot);
  EXPECT_FALSE(places.empty()) << effect.info().id;
  for (const char* place : {"all", "global"}) {
    if (std::count(places.begin(), places.end(), place)) return place;
  }
  return places.empty() ? "" : places.front();
}

bool is_for_balls(const Effect& effect) {
  return effect.places(*load_robot_model(config(kPulley))).empty();
}

class Dissipation : public ::testing::TestWithParam<std::string> {
 protected:
  const Effect& effect() const { return *find_effect(GetParam()); }
  EffectInstance clear_dose(const RobotModel& robot) const {
    return dose(effect(), robot, place_of(effect(), robot), kClear);
  }
};

constexpr double kSeconds = 1.0;

/// Both tendons pull all the time, the flexor over its surface, and the arm swings from where it
/// was put. (A ring that goes slack gives back a little too much, also in the plain model: its
/// stress below zero is cut off.)
Course swing_of_rig(const std::shared_ptr<const RobotModel>& robot, const RobotModel& plain) {
  return let_go(robot, plain, {-0.1}, {3.5, 3.5}, kSeconds);
}

TEST_P(Dissipation, WithoutSupplyTheRobotNeverGainsEnergy) {
  if (is_for_balls(effect())) {
    const Pendulum pendulum(true);
    const auto plain = pendulum.load({});
    const Course course =
        let_go(pendulum.load({clear_dose(*plain)}), *plain, pendulum.tilted(0.5), {}, kSeconds);
    EXPECT_GT(course.lost, 0.0);
    EXPECT_LT(course.gained, 0.01 * course.lost);
    return;
  }
  const auto plain = rig_with({});
  const auto robot = rig_with({clear_dose(*plain)});
  const Course course = swing_of_rig(robot, *plain);
  EXPECT_GT(course.lost, 0.1);  // of 2 J
  EXPECT_LT(course.gained, 1e-6 * course.lost);
}

// --- one bench a seam: what is lost in a motion that is the same with and without the effect -----

/// Of a pendulum that swings for a second: its share of the energy at first [1].
double lost_by_pendulum(const Pendulum& pendulum, const std::vector<EffectInstance>& effects) {
  const double angle = 0.5, weight = 9.81, length = 0.3;
  const auto plain = pendulum.load({});
  return let_go(pendulum.load(effects), *plain, pendulum.tilted(angle), {}, 1.0).lost /
         (weight * length * (1.0 - std::cos(angle)));
}

/// Of a spring that is stretched to and fro from rest, always taut: work that is neither given back
/// nor stored, one number a period [J].
std::vector<double> lost_by_spring(const RobotModel& robot) {
  constexpr double kMean = 0.005, kAmplitude = 0.003, kPeriod = 2.0;  // [m], [s]
  constexpr int kPeriods = 5;
  const SeriesElasticElement& spring = *robot.muscles[kWorking].spring;
  Memory state(spring.state_size());
  spring.relax(kMean, state);
  double before = kMean, force = spring.relaxed_tension(kMean);
  double stored = spring.stored_energy(state);
  std::vector<double> lost;
  for (int period = 0; period < kPeriods; ++period) {
    double work = 0.0;
    const int steps = static_cast<int>(std::lround(kPeriod / kFineStep));
    for (int i = 1; i <= steps; ++i) {
      const double x = kMean + kAmplitude * std::sin(2.0 * M_PI * i / steps);
      const double next = spring.advance(x, state);
      work += 0.5 * (force + next) * (x - before);
      force = next;
      before = x;
    }
    lost.push_back(work - (spring.stored_energy(state) - stored));
    stored = spring.stored_energy(state);
  }
  return lost;
}

/// Of a tendon that slides to and fro: work per tension and angle, one number a period [m].
std::vector<double> lost_by_sliding(const FrictionLaw* law) {
  constexpr double kReach = 0.002;  // [m]; a period takes a second
  constexpr int kPeriods = 3, kSteps = 10000;
  if (!law) return std::vector<double>(kPeriods, 0.0);
  Memory state(law->state_size());
  std::vector<double> lost;
  for (int period = 0; period < kPeriods; ++period) {
    double work = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double v = 2.0 * M_PI * kReach * std::cos(2.0 * M_PI * (i + 0.5) / kSteps);
      work += law->evaluate(v, state).mu * v * kFineStep;
      law->commit(v, state);
    }
    lost.push_back(work);
  }
  return lost;
}

/// Of a motor that backs up and winds in again, while its tendon pulls little on the way back and
/// much on the way in: what tendon and motor put in over a period, once it repeats [J]. Between the
/// flanks of a play the motor carries no load (docs/effects.md).
double lost_in_play(const RobotModel& robot, double width, double much) {
  constexpr double kLittle = 0.5;  // [N] less than the drag of a spindle
  const auto& motor = dynamic_cast<const GearedMotor&>(*robot.muscles[kWorking].actuator);
  const double radius = motor.spindle_radius();
  Memory state(motor.state_size());
  motor.place(0.0, state);
  const double rest_length = motor.tendon_length(state);
  const auto lead = [&] {
    return (rest_length - motor.tendon_length(state)) / radius - motor.read(state).position;
  };
  double lost = 0.0;
  constexpr int kSteps = 10000;
  for (int i = 1; i <= 2 * kSteps; ++i) {
    const double phase = static_cast<double>(i % kSteps) / kSteps;
    const double position = -0.75 * width * (1.0 - std::cos(2.0 * M_PI * phase));
    const double pull = phase > 0.0 && phase <= 0.5 ? kLittle : much;
    const double before = motor.read(state).position, length = motor.tendon_length(state);
    const bool carries = !(lead() > 1e-12 && lead() < width - 1e-12);
    motor.impose(position, (position - before) / kFineStep, pull, state);
    if (i <= kSteps) continue;
    lost += pull * (motor.tendon_length(state) - length);
    if (carries) lost += pull * radius * (position - before);
  }
  return lost;
}

/// A motor at a voltage, in steady motion under a load.
struct SteadyMotion {
  double electrical = 0.0;  ///< that the nominal supply gives [W]
  double mechanical = 0.0;  ///< that the tendon gets [W]
  Actuator::Readout motor = {};
};

/// After a minute, in which a winding warms.
SteadyMotion steady_motion(const RobotModel& robot, double volts, double load) {
  const Actuator& actuator = *robot.muscles[kWorking].actuator;
  const double radius = dynamic_cast<const GearedMotor&>(actuator).spindle_radius();
  Memory state(actuator.state_size());
  actuator.place(0.0, state);
  std::vector<Memory> memories;
  for (const auto& effect : robot.power_effects) {
    memories.emplace_back(effect->state_size());
    effect->reset(memories.back());
  }
  std::vector<PowerLine> lines;
  const int steps = static_cast<int>(std::lround(60.0 / robot.step));
  for (int i = 0; i < steps; ++i) {
    lines.assign(robot.muscles.size(), {0.0, 0.0});
    lines[kWorking] = {volts, actuator.read(state).current};
    for (std::size_t e = 0; e < memories.size(); ++e) {
      robot.power_effects[e]->apply(lines, memories[e]);
    }
    actuator.advance(lines[kWorking].voltage, load, state);
  }
  const Actuator::Readout motor = actuator.read(state);
  // The bridge draws the share V / V_0 of the current at V_0.
  return {volts * motor.current, load * radius * motor.velocity, motor};
}

constexpr double kVolts = 8.0, kLoad = 60.0;  // [V], [N]

void expect_more_lost(const std::vector<double>& with, const std::vector<double>& without,
                      double tolerance) {
  double sum = 0.0, plain = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_GT(with[i], -tolerance) << "period " << i;
    sum += with[i];
    plain += without[i];
  }
  EXPECT_GT(sum, 1.05 * plain + tolerance);
}

void expect_more_lost_by_motor(const RobotModel& plain, const RobotModel& robot) {
  const SteadyMotion without = steady_motion(plain, kVolts, kLoad);
  const SteadyMotion with = steady_motion(robot, kVolts, kLoad);
  ASSERT_GT(with.mechanical, 0.0) << "it winds in";
  EXPECT_LT(with.mechanical, with.electrical);
  EXPECT_LT(with.mechanical / with.electrical, 0.99 * without.mechanical / without.electrical);
  // Driven by the tendon, without voltage: the winding gets no more than the tendon gives.
  const auto& p = static_cast<const DcMotor&>(*plain.muscles[kWorking].actuator).parameters();
  const SteadyMotion driven = steady_motion(robot, 0.0, kLoad);
  ASSERT_LT(driven.mechanical, 0.0) << "it runs down";
  EXPECT_LT(p.resistance * driven.motor.current * driven.motor.current, -driven.mechanical);
}

TEST_P(Dissipation, MoreIsLostThanInThePlainModel) {
  const Seam seam = effect().info().seam;
  if (seam == Seam::kJoints) {
    const Pendulum pendulum(is_for_balls(effect()));
    const double plain = lost_by_pendulum(pendulum, {});
    EXPECT_NEAR(plain, 0.0, 0.01);
    EXPECT_GT(lost_by_pendulum(pendulum, {clear_dose(*pendulum.load({}))}), 0.1);
    return;
  }
  if (seam == Seam::kPath) {
    const auto plain = load_robot_model(config(kPulley));
    const bool on_surface = GetParam() == "wrap_friction";
    LoadOptions options;
    options.step = kFineStep;
    const auto law_of = [&] {
      const auto robot = load_robot_model(config(kPulley), options);
      return robot->muscles[kWorking].path->obstacles()[on_surface ? 2 : 1].friction;
    };
    const auto without = law_of();
    options.effects = {clear_dose(*plain)};
    // The sum over a period errs by a step's share of it at most.
    expect_more_lost(lost_by_sliding(law_of().get()), lost_by_sliding(without.get()), 1e-6);
    return;
  }
  const auto plain = rig_with({});
  const EffectInstance instance = clear_dose(*plain);
  const auto robot = rig_with({instance});
  if (seam == Seam::kTendon || seam == Seam::kSpring) {
    // A three-hundredth of the 0.1 J that a period turns over: effects_spring_test.cpp.
    expect_more_lost(lost_by_spring(*robot), lost_by_spring(*plain), 3e-4);
  } else if (GetParam() == "gear_backlash") {
    const double width = instance.parameters.at("width"), much = 5.0;
    const double crossed = much * 0.0065 * width;  // what the tendon does in the play
    EXPECT_NEAR(lost_in_play(*plain, width, much), 0.0, 1e-9);
    EXPECT_NEAR(lost_in_play(*robot, width, much), crossed, 0.02 * crossed);
  } else if (seam == Seam::kGear || seam == Seam::kMotor || seam == Seam::kPowerStage) {
    expect_more_lost_by_motor(*plain, *robot);
  } else {
    FAIL() << "no bench for the seam of " << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, Dissipation, ::testing::ValuesIn(dissipating()),
                         [](const auto& test) { return test.param; });

// --- closed forms at the seam of motor and gear --------------------------------------------------

TEST(MotorLosses, OfASeriesResistanceAreItsShareOfRISquared) {
  const double added = 0.6;
  const auto plain = rig_with({});
  const auto robot = rig_with({{"series_resistance", "all", {{"resistance", added}}}});
  const auto& p = static_cast<const DcMotor&>(*plain->muscles[kWorking].actuator).parameters();
  for (const double load : {20.0, kLoad}) {
    const SteadyMotion motion = steady_motion(*robot, kVolts, load);
    const double current = motion.motor.current;
    const double shaft = p.ratio * p.torque_constant * current * motion.motor.velocity;
    const double loss = motion.electrical - shaft;
    EXPECT_NEAR(loss, (p.resistance + added) * current * current, 1e-6 * loss) << load;
  }
}

TEST(MotorLosses, AGearPassesOnItsEfficiencyDrivingAndDrivenAndNoMore) {
  const double loss = 0.45, model = 0.59, eta = (1.0 - loss) * model;
  const auto plain = rig_with({});
  const auto robot = rig_with({{"gear_efficiency", "all", {{"loss", loss}}}});
  const auto& p = static_cast<const DcMotor&>(*plain->muscles[kWorking].actuator).parameters();
  ASSERT_EQ(p.friction_torque, 0.0);
  const auto shaft = [&p](const SteadyMotion& motion) {
    return p.ratio * p.torque_constant * motion.motor.current * motion.motor.velocity;
  };
  const SteadyMotion driving = steady_motion(*robot, kVolts, kLoad);
  ASSERT_GT(driving.motor.velocity, 0.0);
  EXPECT_NEAR(driving.mechanical, eta * shaft(driving), 1e-6 * shaft(driving));
  const SteadyMotion driven = steady_motion(*robot, 0.0, kLoad);
  ASSERT_LT(driven.motor.velocity, 0.0);
  EXPECT_NEAR(shaft(driven), eta * driven.mechanical, -1e-6 * driven.mechanical);
}

TEST(EyeletPresliding, TakesLessThanTheFrictionThatItDelays) {
  const double distance = 9e-4;
  const auto law_of = [](const std::vector<EffectInstance>& effects) {
    return robot_with(kArm, effects, kFineStep)->muscles[0].path->obstacles()[1].friction;
  };
  const auto plain = lost_by_sliding(law_of({}).get());
  const auto lost =
      lost_by_sliding(law_of({{"eyelet_presliding", "all", {{"distance", distance}}}}).get());
  EXPECT_GT(lost.back(), 0.0);
  EXPECT_LT(lost.back(), 0.95 * plain.back());
  EXPECT_FALSE(find_effect("eyelet_presliding")->info().dissipates);
}

}  // namespace
}  // namespace anthrob
