#include "anthrob_sim/skeleton/skeleton_model.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace anthrob {

namespace {
template <class T>
int find_by_name(const std::vector<T>& list, const std::string& name) {
  const auto it =
      std::find_if(list.begin(), list.end(), [&](const T& item) { return item.name == name; });
  return it == list.end() ? -1 : static_cast<int>(it - list.begin());
}
}  // namespace

bool BodyModel::find_principal_axes() {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(inertia_L);
  Mat3 axes = eigen.eigenvectors();
  if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
  X_LB = {axes, com_L};
  principal = eigen.eigenvalues();
  const double slack = 1e-6 * principal.sum();
  return principal.minCoeff() > 0.0 && principal[2] <= principal[0] + principal[1] + slack;
}

int SkeletonModel::find_frame(const std::string& name) const {
  return find_by_name(frames, name);
}
int SkeletonModel::find_joint(const std::string& name) const {
  return find_by_name(joints, name);
}

std::vector<double> SkeletonModel::rest_configuration() const {
  std::vector<double> q(position_count, 0.0);
  for (const auto& joint : joints) {
    if (joint.type == JointType::kBall) q[joint.position_offset] = 1.0;
  }
  return q;
}

std::vector<JointOnPath> joints_between(const SkeletonModel& model, int from, int to) {
  // Body b hangs on joint b - 1, and parents have smaller indices: climb from the larger one.
  std::vector<JointOnPath> path;
  while (from != to) {
    if (to > from) {
      path.push_back({to - 1, +1.0});
      to = model.joints[to - 1].parent;
    } else {
      path.push_back({from - 1, -1.0});
      from = model.joints[from - 1].parent;
    }
  }
  return path;
}

std::vector<SweepAxis> sweep_axes(const SkeletonModel& skeleton) {
  std::vector<SweepAxis> axes(static_cast<std::size_t>(skeleton.velocity_count));
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const JointModel& joint = skeleton.joints[j];
    for (int k = 0; k < joint.dof(); ++k) {
      axes[joint.velocity_offset + k] = {
          static_cast<int>(j), k,
          joint.type == JointType::kBall ? joint.name + "_" + "xyz"[k] : joint.name};
    }
  }
  return axes;
}

}  // namespace anthrob
