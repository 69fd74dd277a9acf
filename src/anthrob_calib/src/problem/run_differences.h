#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {
namespace calibration {

/// Weights of the fitness (5.9), (5.20).
struct Weights {
  double posture = 1.0;  ///< kappa_q [1/rad^2]
  double force = 1e-4;   ///< kappa_f [1/N^2]
  double before = 1.0;   ///< kappa_s
  double path = 1.0;     ///< kappa_t
  double after = 1.0;    ///< kappa_e
};

/// Simulated minus measured at some instants: one row each.
struct Differences {
  /// By joint: difference of the position [rad, m], or the rotation vector of a ball joint, whose
  /// length is the angular distance [rad].
  Eigen::MatrixXd posture;
  Eigen::MatrixXd force;     ///< by muscle [N]
  Eigen::MatrixXd actuator;  ///< by muscle [rad]; no columns: not measured
  int joints = 1;

  int count() const { return static_cast<int>(posture.rows()); }
  /// Mean over instants and joints [rad^2].
  double posture_square() const;
  /// Mean over instants and muscles [N^2].
  double force_square() const;
  /// (5.9), (5.18) as means of squares.
  double fitness(const Weights& weights) const;
  /// Absolute error of one joint in each row [rad, m].
  std::vector<double> joint_error(const JointModel& joint) const;
  /// Mean absolute error of each muscle's force [N].
  std::vector<double> force_errors() const;
};

/// A part of a run, as the fitness counts it.
struct RunPart {
  const Differences& differences;
  double share;  ///< of the run's fitness; the shares of a run add up to 1

  /// Factors that turn differences into residuals, whose squares add up to `scale` times the part's
  /// share of the fitness.
  double posture_factor(const Weights& weights, double scale) const;
  double force_factor(const Weights& weights, double scale) const;
};

/// One run, simulated and compared.
struct RunDifferences {
  Differences before, path, after;  ///< empty where the run has none

  /// The parts that the fitness consists of: `after` of an equilibrium, all three of a trajectory.
  /// They refer to this.
  std::vector<RunPart> parts(const Weights& weights) const;

  /// F_S of an equilibrium, F'_T (5.20) of a trajectory.
  double fitness(const Weights& weights) const;
  /// Appends numbers whose squares add up to `share` times the fitness.
  void append_residuals(const Weights& weights, double share, std::vector<double>& residuals) const;
  /// What reports show: the path of a trajectory, the final posture of an equilibrium.
  const Differences& shown() const { return path.count() > 0 ? path : after; }
};

/// Posture b minus posture a, in the form of a row of Differences::posture.
void posture_row(const SkeletonModel& skeleton, const double* a, const double* b, double* row);

}  // namespace calibration
}  // namespace anthrob
