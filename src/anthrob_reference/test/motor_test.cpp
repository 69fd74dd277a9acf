#include "anthrob_reference/motor.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <vector>

#include "anthrob_reference/controller.h"
#include "support.h"

namespace anthrob::reference {
namespace {

// An arm whose first tendon is so slack that its motor runs free.
Arm free_running(MotorParameters* motor) {
  const ArmParameters parameters = Arm::load(model_file("model_I"));
  *motor = parameters.muscles.front().motor;
  Arm arm(parameters);
  std::vector<double> positions(arm.muscle_count(), 0.0);
  positions.front() = -20.0;
  arm.place(Eigen::Quaterniond::Identity(), 0.0, positions);
  return arm;
}

TEST(Motor, NoLoadSpeed) {
  MotorParameters motor;
  Arm arm = free_running(&motor);
  arm.command_voltage(0, 6.0);
  arm.advance(0.2);
  EXPECT_NEAR(arm.muscle(0).velocity, 6.0 / (motor.back_emf_constant * motor.gear_ratio), 1e-9);
  EXPECT_NEAR(arm.muscle(0).current, 0.0, 1e-9);
  EXPECT_EQ(arm.muscle(0).force, 0.0);
}

TEST(Motor, RunsUpAsTheLinearCircuit) {
  MotorParameters motor;
  Arm arm = free_running(&motor);
  const double emf = motor.back_emf_constant * motor.gear_ratio;
  const double inertia =
      motor.gear_ratio * motor.gear_ratio * (motor.rotor_inertia + motor.gear_inertia);
  Eigen::Matrix2d A;
  A << -(motor.resistance + motor.power_stage_resistance) / motor.inductance,
      -emf / motor.inductance, motor.torque_constant * motor.gear_ratio / inertia, 0.0;
  const Eigen::EigenSolver<Eigen::Matrix2d> modes(A);
  const Eigen::Vector2cd final_state(0.0, 6.0 / emf);
  const Eigen::Vector2cd weights = modes.eigenvectors().inverse() * final_state;
  arm.command_voltage(0, 6.0);
  for (int k = 1; k <= 20; ++k) {
    arm.advance(1e-3);
    const Eigen::Vector2cd decay = (modes.eigenvalues().array() * (1e-3 * k)).exp();
    const Eigen::Vector2d exact =
        (final_state - modes.eigenvectors() * decay.cwiseProduct(weights)).real();
    EXPECT_NEAR(arm.muscle(0).current, exact(0), 1e-4);
    EXPECT_NEAR(arm.muscle(0).velocity, exact(1), 1e-5);
  }
}

TEST(Motor, EfficiencyHelpsTheLoadHolderOnly) {
  const MotorParameters parameters = Arm::load(model_file("model_I")).muscles.front().motor;
  const Motor motor(parameters);
  EXPECT_NEAR(motor.efficiency(2.0, 3.0), 0.59, 1e-12);
  EXPECT_NEAR(motor.efficiency(2.0, -3.0), 1.0 / 0.59, 1e-12);
  // (4.13) as printed, at standstill and half way.
  EXPECT_NEAR(motor.efficiency(2.0, 0.0),
              0.59 + (1.0 / 0.59 - 0.59) * (std::tanh(-3.0) + 1.0) / 2.0, 1e-12);
  EXPECT_NEAR(motor.efficiency(-0.3, 1.0), 0.5 * (0.59 + 1.0 / 0.59), 1e-12);
}

TEST(Motor, LoadIsHeldByTheCurrentThroughGearLosses) {
  const MotorParameters parameters = Arm::load(model_file("model_I")).muscles.front().motor;
  const Motor motor(parameters);
  const double current = 2.0;
  const double load = 0.59 * parameters.gear_ratio * parameters.torque_constant * current;
  EXPECT_NEAR(motor.acceleration(current, 3.0, load), 0.0, 1e-9);
}

TEST(Motor, LinearSolveInvertsItsJacobian) {
  const MotorParameters parameters = Arm::load(model_file("model_I")).muscles.front().motor;
  const Motor motor(parameters);
  const double shift = 3e4;
  double current = 0.7;
  double speed = -0.4;
  motor.solve_linear(shift, &current, &speed);
  EXPECT_NEAR(shift * current - motor.current_rate(0.0, current, speed), 0.7, 1e-9);
  EXPECT_NEAR(shift * speed - motor.acceleration(current, speed, 0.0), -0.4, 1e-9);
}

TEST(Controller, PositionLawAndClip) {
  const ControllerParameters gains{1e-3, 12.0, 5.0, 0.5, 0.01};
  Controller controller(gains);
  EXPECT_EQ(controller.update(1.0, 1.0, 1.0), 0.0);
  controller.command_position(2.0);
  EXPECT_NEAR(controller.update(1.5, 0.4, 30.0), 5.0 * 0.5 - 0.5 * 0.4 + 0.01 * 30.0, 1e-12);
  EXPECT_EQ(controller.update(-10.0, 0.0, 0.0), 12.0);
  EXPECT_EQ(controller.update(20.0, 0.0, 0.0), -12.0);
  controller.command_voltage(-3.0);
  EXPECT_EQ(controller.update(0.0, 9.0, 9.0), -3.0);
  controller.command_voltage(40.0);
  EXPECT_EQ(controller.update(0.0, 0.0, 0.0), 12.0);
}

TEST(Controller, HoldsTheVoltageBetweenTicks) {
  Arm arm(Arm::load(model_file("model_I")));
  const double expected = 0.5 * 5.7295779513082 + 0.0050 * arm.muscle(0).force;
  arm.command_position(0, 0.5);
  arm.advance(4e-4);
  const double first = arm.muscle(0).voltage;
  EXPECT_NEAR(first, expected, 1e-9);
  arm.command_position(0, -0.5);
  arm.advance(5e-4);
  EXPECT_EQ(arm.muscle(0).voltage, first);
  arm.advance(2e-4);
  EXPECT_LT(arm.muscle(0).voltage, 0.0);
  EXPECT_NEAR(arm.time(), 1.1e-3, 1e-15);
}

}  // namespace
}  // namespace anthrob::reference
