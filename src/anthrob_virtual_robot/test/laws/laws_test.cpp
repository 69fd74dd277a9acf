// Closed forms of single laws.
#include <gtest/gtest.h>

#include "support.h"

namespace anthrob::virtual_robot {
namespace {

constexpr const char* kMuscle = "biceps_brachii";

double rest_tendon_length() {
  Draft draft;
  draft.arm = model_I();
  return draft.arm.muscles[draft.muscle(kMuscle)].rest_tendon_length;
}

const reference::RingParameters& ring() {
  Draft draft;
  draft.arm = model_I();
  return model_I().muscles[draft.muscle(kMuscle)].ring;
}

double ring_stiffness() {
  const auto& r = ring();
  return r.quantity * r.strands * M_PI / 4.0 * r.section_diameter * r.section_diameter * r.modulus /
         r.rest_length;
}

TEST(SpindleGrowth, RadiusIsTheSlopeOfWhatIsWoundAndGrowsByTheLayerEachTurn) {
  const auto law = muscle_law({"spindle_growth", kMuscle, {{"growth", 3e-4}}});
  for (const double position : {-3.0, 0.4, 2.0, 9.0}) {
    const double h = 1e-5;
    const double slope = (law->wound(position + h) - law->wound(position - h)) / (2.0 * h);
    EXPECT_NEAR(law->leverage(position), slope, 1e-10);
    EXPECT_NEAR(law->leverage(position + 2.0 * M_PI) - law->leverage(position), 3e-4, 1e-12);
  }
  EXPECT_EQ(law->wound(0.0), 0.0);
}

TEST(TendonElasticity, IsLinearBeyondTheBedOfTheBraid) {
  const auto law = muscle_law({"tendon_elasticity", kMuscle, {{"compliance", 1e-4}}});
  law->settle(1e-3, {}, solution_of(0.1, 60.0));
  const double at_60 = law->elongation();
  law->settle(1e-3, {}, solution_of(0.1, 80.0));
  EXPECT_NEAR(law->elongation() - at_60, 1e-4 * rest_tendon_length() * 20.0, 1e-9);
}

/// How much of a shape is in what a law does, beside all multiples of other shapes.
double amount_in(const std::vector<double>& what, const std::vector<double>& shape,
                 const std::vector<std::vector<double>>& others) {
  const auto n = static_cast<Eigen::Index>(what.size());
  Eigen::MatrixXd A(n, static_cast<Eigen::Index>(others.size()) + 1);
  A.col(0) = Eigen::Map<const Eigen::VectorXd>(shape.data(), n);
  for (std::size_t k = 0; k < others.size(); ++k) {
    A.col(static_cast<Eigen::Index>(k) + 1) =
        Eigen::Map<const Eigen::VectorXd>(others[k].data(), n);
  }
  const Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(what.data(), n);
  return A.colPivHouseholderQr().solve(b)[0];
}

// A size that is hidden is compared with the one that is found: where a law of another shape is
// used, the catalogue's equation that fits it best must have about that size.

TEST(TendonCreep, FollowsTheHardeningLogarithmUnderAForceThatChanges) {
  const double rate = 5e-5, h = 0.01;
  const auto law = muscle_law({"tendon_creep", kMuscle, {{"rate", rate}, {"onset", 1.0}}});
  Random random(1);
  std::vector<double> elongation, logarithm, shift;
  double crept = 0.0, force = 10.0, from = 10.0, to = 10.0, left = 0.0;
  for (double t = 0.0; t < 120.0; t += h, left -= h) {
    if (left <= 0.0) {
      from = to, to = random.uniform(3.0, 20.0);
      left = random.uniform(0.9, 2.3);
    }
    force += std::clamp(to - force, -std::abs(to - from) * h / 0.3, std::abs(to - from) * h / 0.3);
    law->settle(h, {}, solution_of(0.1, force));
    crept += h * force / 1.25 * std::exp(-crept / force);  // onset a little later
    elongation.push_back(law->elongation() / rest_tendon_length());
    logarithm.push_back(crept);
    shift.push_back(1.0);
  }
  EXPECT_NEAR(amount_in(elongation, logarithm, {shift}) / rate, 1.0, 0.1);
}

TEST(SeeToe, FollowsTheParabolaWhereRingsWork) {
  const auto law = muscle_law({"see_toe", kMuscle, {{"softness", 0.6}, {"strain", 0.5}}});
  const double reach = 0.5 * ring().rest_length;
  double closest = HUGE_VAL, softness = 0.0;
  for (double strain = 0.6; strain < 2.0; strain += 0.01) {  // of 0.5; it is fitted, too
    std::vector<double> force, parabola, shift;
    for (double x = 0.2; x < 0.8; x += 0.01) {
      force.push_back(law->spring_force(x * reach));
      parabola.push_back(-ring_stiffness() * x * reach *
                         (x < strain ? std::pow(1.0 - x / strain, 2) : 0.0));
      shift.push_back(1.0);
    }
    const double amount = amount_in(force, parabola, {shift});
    std::vector<double> left = force;
    for (std::size_t i = 0; i < left.size(); ++i) left[i] -= amount * parabola[i];
    const double constant = amount_in(left, shift, {});
    double square = 0.0;
    for (const double value : left) square += std::pow(value - constant, 2);
    if (square >= closest) continue;
    closest = square;
    softness = amount;
  }
  EXPECT_NEAR(softness / 0.6, 1.0, 0.12);
}

TEST(SeeMullins, FollowsTheParabolaBelowTheLargestStretch) {
  const auto law = muscle_law({"see_mullins", kMuscle, {{"softening", 0.25}}});
  law->settle(1e-3, {}, solution_of(0.4, 0.0));
  std::vector<double> force, parabola;
  for (double x = 0.05; x < 1.0; x += 0.01) {
    const double stretch = 0.4 * x * ring().rest_length;
    force.push_back(law->spring_force(stretch));
    parabola.push_back(-ring_stiffness() * stretch * (1.0 - x * x));
  }
  EXPECT_NEAR(amount_in(force, parabola, {}) / 0.25, 1.0, 0.05);
}

TEST(SeeStiffening, FollowsTheExponentialWhereRingsWork) {
  for (const double rate : {0.4, 1.0, -0.4, -1.0}) {
    const auto law = muscle_law({"see_stiffening", kMuscle, {{"stiffening", rate}}});
    std::vector<double> force, exponential, linear;
    for (double strain = 0.1; strain < 0.8; strain += 0.01) {
      force.push_back(law->spring_force(strain * ring().rest_length));
      exponential.push_back(ring_stiffness() * ring().rest_length *
                            (std::expm1(rate * strain) / rate - strain));
    }
    EXPECT_NEAR(amount_in(force, exponential, {}), 1.0, 0.12) << rate;
  }
}

TEST(MotorFriction, IsThereAfterATurnOfTheRotorAndHoldsItsSignAtRest) {
  const double torque = 4e-4;
  Draft draft;
  draft.arm = model_I();
  const double ratio = draft.arm.muscles[draft.muscle(kMuscle)].motor.gear_ratio;
  const auto law = muscle_law({"motor_friction", kMuscle, {{"torque", torque}}});
  const auto turn = [&](double speed, double rotor_angle) {
    reference::MuscleState state;
    state.speed = speed;
    const auto steps = static_cast<int>(rotor_angle / ratio / std::abs(speed) / 1e-4);
    for (int i = 0; i < steps; ++i) law->settle(1e-4, state, {});
    return law->output_torque(0.0, speed) / (torque * ratio);
  };
  EXPECT_NEAR(turn(0.7, 2.0 * M_PI), -1.0, 1e-3);
  EXPECT_NEAR(turn(-0.7, 0.3), 1.0 - 2.0 * std::exp(-1.0), 0.02);
  law->settle(1e-4, {}, {});
  EXPECT_NEAR(law->output_torque(0.0, 0.0) / (torque * ratio), 1.0 - 2.0 * std::exp(-1.0), 0.02);
  EXPECT_NEAR(turn(-3.0, 2.0 * M_PI), 1.0, 1e-3);
}

TEST(SpindleGrowth, FollowsTheSteadyGrowthAlsoOverAPartOfATurn) {
  const auto law = muscle_law({"spindle_growth", kMuscle, {{"growth", 3e-4}}});
  for (const auto& [from, to] :
       std::vector<std::pair<double, double>>{{-1.0, 1.0}, {-0.5, 2.0}, {-2.0, 4.0}, {0.0, 6.0}}) {
    std::vector<double> wound, steady, radius, shift;
    for (double position = from; position < to; position += 0.02) {
      wound.push_back(law->wound(position));
      steady.push_back(position * position / (4.0 * M_PI));
      radius.push_back(position);
      shift.push_back(1.0);
    }
    EXPECT_NEAR(amount_in(wound, steady, {radius, shift}) / 3e-4, 1.0, 0.2) << from << " " << to;
  }
}

TEST(CableDrag, FollowsTheLinearOneOverTheElbowsRange) {
  for (const double rest : {0.0, 0.6, 1.2}) {
    Draft draft;
    draft.arm = model_I();
    build_in({"cable_drag", "elbow", {{"stiffness", 0.1}, {"rest", rest}}}, &draft);
    std::vector<double> torque, linear, shift;
    for (double q = 0.21; q < 1.31; q += 0.01) {
      reference::JointState state;
      state.elbow = q;
      torque.push_back(draft.joint_laws.at(0)->torque(state)(3));
      linear.push_back(-q);
      shift.push_back(1.0);
    }
    EXPECT_NEAR(amount_in(torque, linear, {shift}) / 0.1, 1.0, 0.1) << rest;
  }
}

TEST(SecondMaxwellArm, StepRelaxesWithItsTimeWhereItIsSmall) {
  const auto law =
      muscle_law({"second_maxwell_arm", kMuscle, {{"ratio", 0.15}, {"relaxation_time", 10.0}}});
  law->settle(1e-3, {}, solution_of(0.1, 0.0));  // at rest there
  const double stretch = (0.1 + 1e-3) * ring().rest_length;
  const double step = law->spring_force(stretch);
  EXPECT_NEAR(step, 0.15 * ring_stiffness() * 1e-3 * ring().rest_length, 1e-9);
  for (int k = 0; k < 10000; ++k) law->settle(1e-3, {}, solution_of(0.1 + 1e-3, 0.0));
  EXPECT_NEAR(law->spring_force(stretch) / step, std::exp(-1.0), 1e-3);
}

TEST(SeeHysteresis, LoopDoesNotDependOnRateAndEndsAtItsShare) {
  const double share = 0.12, turn = 0.05;
  const auto law = muscle_law({"see_hysteresis", kMuscle, {{"share", share}, {"turn", turn}}});
  const double limit = share * ring_stiffness() * 0.3 * ring().rest_length;
  const auto go = [&](double from, double to, int steps) {
    for (int k = 1; k <= steps; ++k) {
      law->settle(1e-3, {}, solution_of(from + (to - from) * k / steps, 0.0));
    }
    return law->spring_force(to * ring().rest_length);
  };
  law->settle(1e-3, {}, solution_of(0.2, 0.0));
  EXPECT_NEAR(go(0.2, 0.6, 50), limit, 1e-9);
  EXPECT_NEAR(go(0.6, 0.2, 5000), -limit, 1e-9);
  // 63 % of the way between the limits after one turn.
  EXPECT_NEAR(go(0.2, 0.2 + turn, 100) / limit, 1.0 - 2.0 * std::exp(-1.0), 0.06);
}

TEST(SeeMullins, SoftensBelowTheLargestStretchOnly) {
  const auto law = muscle_law({"see_mullins", kMuscle, {{"softening", 0.25}}});
  law->settle(1e-3, {}, solution_of(0.4, 0.0));
  const double largest = 0.4 * ring().rest_length;
  EXPECT_EQ(law->spring_force(largest), 0.0);
  EXPECT_EQ(law->spring_force(1.5 * largest), 0.0);
  EXPECT_NEAR(law->spring_force(1e-4 * largest) / (1e-4 * largest), -0.25 * ring_stiffness(),
              1e-3 * ring_stiffness());
}

TEST(EyeletPresliding, HoldsItsSignAtRestAndComesBackOverTheDistance) {
  const double distance = 5e-4;
  const auto law = muscle_law({"eyelet_presliding", kMuscle, {{"distance", distance}}});
  for (int k = 0; k < 100; ++k) law->settle(1e-3, {}, solution_of(0.1, 0.0, 0.05));
  const double full = law->friction(0, 0.0, 0.0);
  EXPECT_NEAR(full, 0.195, 1e-12);  // static level of model I, at rest
  for (int k = 0; k < 100; ++k) law->settle(1e-3, {}, solution_of(0.1, 0.0, -distance / 0.1));
  EXPECT_NEAR(law->friction(0, 0.0, 0.0) / full, -(1.0 - 2.0 * std::exp(-1.0)), 0.1);
}

TEST(GearBacklash, FreeSpindleCarriesNothingAndTheOtherFlankTakesItAlong) {
  const auto law = muscle_law({"gear_backlash", kMuscle, {{"width", 0.02}, {"drag", 0.05}}});
  const double radius = model_I().muscles[0].spindle_radius;
  reference::MuscleState state;
  law->settle(1e-3, state, solution_of(0.1, 1.0));  // 1 N does not overcome the drag
  state.position = -0.01;
  law->settle(1e-3, state, solution_of(0.1, 1.0));
  EXPECT_NEAR(law->wound(0.0), 0.01 * radius, 1e-12);
  EXPECT_NEAR(law->leverage(0.0), -radius, 1e-12);
  state.position = -0.05;
  law->settle(1e-3, state, solution_of(0.1, 1.0));
  EXPECT_NEAR(law->wound(0.0), 0.02 * radius, 1e-12);
  EXPECT_EQ(law->leverage(0.0), 0.0);
}

TEST(EncoderDrift, LosesWholeCountsWithTheWayFromWhereTheRobotWasPut) {
  Draft draft;
  draft.arm = model_I();
  const std::size_t muscle = draft.muscle(kMuscle);
  const Hidden lost{"encoder_drift", kMuscle, {{"rate", 0.0}, {"missed", 0.05}}};
  build_in(lost, &draft);
  const auto law = draft.reading_laws.back();
  const auto read = [&](double position) {
    Readings readings;
    readings.muscles.resize(draft.arm.muscles.size());
    readings.muscles[muscle].position = position;
    law->apply(&readings);
    return readings.muscles[muscle].position;
  };
  EXPECT_EQ(read(0.0), 0.0);
  law->start();  // put elsewhere: that is no way
  EXPECT_EQ(read(2.0), 2.0);
  // There and back again by 0.5 rad: a twentieth of 1 rad, in counts of 0.0061 rad.
  EXPECT_NEAR(read(2.5), 2.5 - 4.0 * 0.0061, 1e-12);
  EXPECT_NEAR(read(2.0), 2.0 - 8.0 * 0.0061, 1e-12);
}

TEST(WindingHeating, SettlesAtThePowerTimesTheResistance) {
  const auto law = muscle_law({"winding_heating",
                               kMuscle,
                               {{"thermal_resistance", 20.0},
                                {"time_constant", 50.0},
                                {"copper", 0.0039},
                                {"magnet", 0.001}}});
  reference::MuscleState state;
  state.current = 0.5;
  reference::MotorParameters motor = model_I().muscles[0].motor;
  const double cold = motor.resistance;
  for (int k = 0; k < 100000; ++k) law->settle(0.01, state, solution_of(0.1, 1.0));
  ASSERT_TRUE(law->retune(&motor));
  // dT = 20 K/W R i^2 with R at that temperature.
  const double power = cold * 0.25;
  const double warmth = 20.0 * power / (1.0 - 20.0 * power * 0.0039);
  EXPECT_NEAR(motor.resistance, cold * (1.0 + 0.0039 * warmth), 1e-6);
}

TEST(JointCoulomb, SlidesAtItsTorqueAndKeepsItAtRest) {
  Draft draft;
  draft.arm = model_I();
  build_in({"joint_coulomb",
            "elbow",
            {{"torque", 0.1}, {"static_ratio", 1.3}, {"stribeck_velocity", 0.05}}},
           &draft);
  const auto& law = draft.joint_laws.at(0);
  reference::JointState state;
  state.velocity(3) = 1.0;
  for (int k = 0; k < 1000; ++k) law->settle(1e-3, state, Eigen::Vector3d::Zero());
  // Bristles, and 2 % of it for each rad/s.
  EXPECT_NEAR(law->torque(state)(3), -0.1 * (1.0 + 0.02), 1e-6);
  state.velocity.setZero();
  EXPECT_NEAR(law->torque(state)(3), -0.1, 1e-6);
  EXPECT_EQ(law->torque(state)(0), 0.0);
}

TEST(BallJointLoadFriction, IsMuTimesRadiusTimesLoad) {
  Draft draft;
  draft.arm = model_I();
  build_in({"ball_joint_load_friction", "shoulder", {{"mu", 0.15}, {"radius", 0.015}}}, &draft);
  const auto& law = draft.joint_laws.at(0);
  reference::JointState state;
  state.velocity << 0.0, 3.0, 4.0, 0.0;
  law->settle(1e-3, state, Eigen::Vector3d(0.0, 0.0, 100.0));
  EXPECT_NEAR(law->torque(state).head<3>().norm(), 0.15 * 0.015 * 100.0, 1e-12);
  EXPECT_LT(law->torque(state).dot(state.velocity), 0.0);
}

TEST(ShoulderHardening, IsTheSquareOfTheTurnBeyondTheLooseOneAndPullsBack) {
  Draft draft;
  draft.arm = model_I();
  build_in({"shoulder_hardening", "shoulder", {{"stiffness", 5.0}, {"loose", 0.4}}}, &draft);
  const auto& law = draft.joint_laws.at(0);
  const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 2.0) / 3.0;
  reference::JointState state;
  const auto torque_at = [&](double turn) {
    state.shoulder = Eigen::AngleAxisd(turn, axis);
    return law->torque(state);
  };
  EXPECT_TRUE(torque_at(0.39).isZero(0.0));
  for (const double turn : {0.5, 0.9, 1.4}) {
    const reference::Vector4 torque = torque_at(turn);
    EXPECT_NEAR((torque.head<3>() + 5.0 * std::pow(turn - 0.4, 2) * axis).norm(), 0.0, 1e-12);
    EXPECT_EQ(torque(3), 0.0);
  }
}

TEST(WeakAboveAngle, TakesItsShareOfTheVoltageOfOneMuscleBeyondTheAngle) {
  Draft draft;
  draft.arm = model_I();
  build_in({"weak_above_angle", kMuscle, {{"loss", 0.3}, {"angle", 1.2}}}, &draft);
  const std::size_t muscle = draft.muscle(kMuscle), other = muscle + 1;
  Readings now;
  now.muscles.resize(draft.arm.muscles.size());
  for (const double position : {-2.0, 1.19, 1.21, 3.0}) {
    now.muscles[muscle].position = position;
    now.muscles[other].position = 3.0;
    std::vector<double> voltages(now.muscles.size(), -2.0);
    draft.power_laws.at(0)->apply(1e-3, now, &voltages);
    EXPECT_NEAR(voltages[muscle], position > 1.2 ? -1.4 : -2.0, 1e-12) << position;
    EXPECT_EQ(voltages[other], -2.0);
  }
}

TEST(SlippingKnot, SlipsExponentiallyWhileTheTensionIsTooHighAndNeverComesBack) {
  const double slip = 0.003, h = 1e-4;
  const auto law = muscle_law({"slipping_knot", kMuscle, {{"slip", slip}, {"holds", 15.0}}});
  const auto pull = [&](double force, double duration) {
    for (int k = 0; k < std::lround(duration / h); ++k) {
      law->settle(h, {}, solution_of(0.1, force));
    }
    return law->elongation();
  };
  EXPECT_EQ(pull(14.9, 1.0), 0.0);
  const double half_a_second = slip * (1.0 - std::exp(-1.0));  // its time constant
  EXPECT_NEAR(pull(15.1, 0.5), half_a_second, 1e-3 * slip);
  EXPECT_NEAR(pull(5.0, 1.0), half_a_second, 1e-3 * slip);
  EXPECT_NEAR(pull(80.0, 10.0), slip, 1e-6 * slip) << "only once";
}

TEST(ForceCompression, LosesItsShareOfWhatIsBeyondTheKnee) {
  Draft draft;
  draft.arm = model_I();
  build_in({"force_compression", kMuscle, {{"share", 0.3}, {"knee", 10.0}}}, &draft);
  const std::size_t muscle = draft.muscle(kMuscle), other = muscle + 1;
  for (const double force : {0.0, 9.9, 10.0, 20.0, 60.0}) {
    Readings readings;
    readings.muscles.resize(draft.arm.muscles.size());
    readings.muscles[muscle].force = readings.muscles[other].force = force;
    draft.reading_laws.at(0)->apply(&readings);
    const double seen = force < 10.0 ? force : 10.0 + 0.7 * (force - 10.0);
    EXPECT_NEAR(readings.muscles[muscle].force, seen, 1e-12) << force;
    EXPECT_EQ(readings.muscles[other].force, force);
  }
}

}  // namespace
}  // namespace anthrob::virtual_robot
