#include "problem/run_differences.h"

#include <Eigen/Geometry>
#include <cmath>

namespace anthrob {
namespace calibration {

namespace {

double mean_square(const Eigen::MatrixXd& m, double per_row) {
  if (m.size() == 0) return 0.0;
  return m.squaredNorm() / (static_cast<double>(m.rows()) * per_row);
}

void append(const Eigen::MatrixXd& m, double factor, std::vector<double>& out) {
  for (Eigen::Index row = 0; row < m.rows(); ++row) {
    for (Eigen::Index column = 0; column < m.cols(); ++column) {
      out.push_back(factor * m(row, column));
    }
  }
}

}  // namespace

double Differences::posture_square() const {
  return mean_square(posture, joints);
}

double Differences::force_square() const {
  return mean_square(force, static_cast<double>(force.cols()));
}

double Differences::fitness(const Weights& weights) const {
  return weights.posture * posture_square() + weights.force * force_square();
}

std::vector<double> Differences::force_errors() const {
  std::vector<double> errors;
  for (Eigen::Index m = 0; m < force.cols(); ++m) {
    errors.push_back(force.col(m).cwiseAbs().mean());
  }
  return errors;
}

std::vector<double> Differences::joint_error(const JointModel& joint) const {
  std::vector<double> error;
  for (Eigen::Index row = 0; row < posture.rows(); ++row) {
    error.push_back(posture.row(row).segment(joint.velocity_offset, joint.dof()).norm());
  }
  return error;
}

double RunPart::posture_factor(const Weights& weights, double scale) const {
  return std::sqrt(scale * share / differences.count() * weights.posture / differences.joints);
}

double RunPart::force_factor(const Weights& weights, double scale) const {
  return std::sqrt(scale * share / differences.count() * weights.force /
                   static_cast<double>(differences.force.cols()));
}

std::vector<RunPart> RunDifferences::parts(const Weights& weights) const {
  if (path.count() == 0) return {{after, 1.0}};
  const double sum = weights.before + weights.path + weights.after;
  return {{before, weights.before / sum}, {path, weights.path / sum}, {after, weights.after / sum}};
}

double RunDifferences::fitness(const Weights& weights) const {
  double sum = 0.0;
  for (const RunPart& part : parts(weights)) sum += part.share * part.differences.fitness(weights);
  return sum;
}

void RunDifferences::append_residuals(const Weights& weights, double share,
                                      std::vector<double>& residuals) const {
  for (const RunPart& part : parts(weights)) {
    append(part.differences.posture, part.posture_factor(weights, share), residuals);
    append(part.differences.force, part.force_factor(weights, share), residuals);
  }
}

void posture_row(const SkeletonModel& skeleton, const double* a, const double* b, double* row) {
  for (const JointModel& joint : skeleton.joints) {
    const double* from = a + joint.position_offset;
    const double* to = b + joint.position_offset;
    double* out = row + joint.velocity_offset;
    if (joint.type != JointType::kBall) {
      *out = *to - *from;
      continue;
    }
    const Quat from_q = Quat(from[0], from[1], from[2], from[3]).normalized();
    const Quat to_q = Quat(to[0], to[1], to[2], to[3]).normalized();
    const Quat turn = canonical(from_q.conjugate() * to_q);
    const double sine = turn.vec().norm();
    const double scale = sine < 1e-12 ? 2.0 : 2.0 * std::atan2(sine, turn.w()) / sine;
    Eigen::Map<Vec3> vector(out);
    vector = scale * turn.vec();
  }
}

}  // namespace calibration
}  // namespace anthrob
