#include "anthrob_control/posture_model.h"

#include <cmath>
#include <stdexcept>

#include "anthrob_sim/effects/effect.h"
#include "anthrob_sim/skeleton/skeleton_model.h"

namespace anthrob {

namespace {

/// Wrapping is followed in steps not larger than this [rad, 0.1 m].
constexpr double kLargestStep = 0.05;

}  // namespace

PostureModel::PostureModel(std::shared_ptr<const RobotModel> model)
    : model_(std::move(model)), tree_(*model_->skeleton) {
  const SkeletonModel& skeleton = *model_->skeleton;
  const Eigen::Index n = skeleton.velocity_count,
                     m = static_cast<Eigen::Index>(model_->muscles.size());
  zero_.assign(skeleton.velocity_count, 0.0);
  u_world_ = zero_;
  arms_ = Eigen::MatrixXd::Zero(n, m);
  mass_ = Eigen::MatrixXd::Zero(n, n);
  load_ = Eigen::VectorXd::Zero(n);
  q_ = way_ = skeleton.rest_configuration();
  tree_.place(q_, zero_, bodies_);
  for (const MuscleModel& muscle : model_->muscles) {
    paths_.emplace_back(*muscle.path);
    path_states_.emplace_back(muscle.path->state_size() + 1, 0.0);
    paths_.back().initialise(bodies_, StateView(path_states_.back().data()));
  }
  update(q_, load_);
}

void PostureModel::place(const std::vector<double>& q, const std::vector<double>& u) {
  tree_.place(q, u, bodies_);
  for (std::size_t m = 0; m < paths_.size(); ++m)
    paths_[m].update(bodies_, StateView(path_states_[m].data()));
}

void PostureModel::update(const std::vector<double>& q, const Eigen::VectorXd& u) {
  const SkeletonModel& skeleton = *model_->skeleton;
  if (q.size() != q_.size() || u.size() != load_.size()) {
    throw std::invalid_argument("PostureModel: sizes of posture and velocity do not fit the robot");
  }
  bool finite = u.allFinite();
  for (const double value : q) finite = finite && std::isfinite(value);
  if (!finite) throw std::invalid_argument("PostureModel: posture or velocity is not finite");

  const int steps = static_cast<int>(std::ceil(posture_distance(skeleton, q_, q) / kLargestStep));
  for (int i = 1; i < steps; ++i) {
    posture_between(skeleton, q_, q, static_cast<double>(i) / steps, way_);
    place(way_, zero_);
  }
  // A ball joint's velocity is measured in the child's axes; the tree wants the world's.
  place(q, zero_);
  q_ = q;
  tree_.update(bodies_, q_);
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const JointModel& joint = skeleton.joints[j];
    const int at = joint.velocity_offset;
    if (joint.type == JointType::kBall) {
      Eigen::Map<Vec3> world(&u_world_[at]);
      world = tree_.joint(static_cast<int>(j)).R_WC * u.segment<3>(at);
    } else {
      u_world_[at] = u[at];
    }
  }
  tree_.place(q, u_world_, bodies_);
  tree_.update(bodies_, q_);
  tree_.update_dynamics(bodies_, model_->gravity);
  arms_.setZero();
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    for (std::size_t i = 0; i < paths_[m].segments().size(); ++i)
      paths_[m].add_moment_arms(i, 1.0, tree_, arms_.col(static_cast<Eigen::Index>(m)).data());
  }
  mass_ = tree_.mass_matrix();
  load_ = -tree_.bias();
  for (const auto& torque : model_->joint_torques) torque->add(tree_, q_, load_.data());
  load_ = -load_;
  turn_into_child_axes();
}

void PostureModel::turn_into_child_axes() {
  const SkeletonModel& skeleton = *model_->skeleton;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].type != JointType::kBall) continue;
    const int at = skeleton.joints[j].velocity_offset;
    const Mat3 to_child = tree_.joint(static_cast<int>(j)).R_WC.transpose();
    for (Eigen::Index m = 0; m < arms_.cols(); ++m) {
      const Vec3 arm = arms_.block<3, 1>(at, m);
      arms_.block<3, 1>(at, m) = to_child * arm;
    }
    const Vec3 load = load_.segment<3>(at);
    load_.segment<3>(at) = to_child * load;
    for (Eigen::Index k = 0; k < mass_.cols(); ++k) {
      const Vec3 column = mass_.block<3, 1>(at, k);
      mass_.block<3, 1>(at, k) = to_child * column;
    }
    for (Eigen::Index k = 0; k < mass_.rows(); ++k) {
      const Vec3 row = mass_.block<1, 3>(k, at).transpose();
      mass_.block<1, 3>(k, at) = (to_child * row).transpose();
    }
  }
}

}  // namespace anthrob
