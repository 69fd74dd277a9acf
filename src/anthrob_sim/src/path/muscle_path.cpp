#include "anthrob_sim/path/muscle_path.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

namespace {

/// Shorter pieces of a path have no direction of their own: rounding of world coordinates is 1e-16
/// m, and no motion comes this close but for points that lie in one place on purpose.
constexpr double kNoLength = 1e-9;  // [m]

/// Angle between two unit vectors, accurate for small angles too [rad].
double angle_between(const Vec3& a, const Vec3& b) {
  const double cosine = a.dot(b);
  if (cosine > 0.5) return 2.0 * std::asin(0.5 * (b - a).norm());
  return std::acos(std::max(-1.0, cosine));
}

}  // namespace

PathModel::PathModel(const SkeletonModel& skeleton, std::vector<PathObstacle> obstacles)
    : obstacles_(std::move(obstacles)) {
  for (std::size_t i = 1; i + 1 < obstacles_.size(); ++i) prepare_surface(i);
  for (const auto& obstacle : obstacles_) {
    state_offsets_.push_back(state_size_);
    if (obstacle.surface) state_size_ += obstacle.surface->state_size();
    if (obstacle.friction) state_size_ += obstacle.friction->state_size();
  }
  for (std::size_t i = 0; i + 1 < obstacles_.size(); ++i) {
    const PathObstacle &a = obstacles_[i], &b = obstacles_[i + 1];
    joints_.push_back(joints_between(skeleton, a.body, b.body));
    static_.push_back(!a.surface && !b.surface && a.body == 0 && b.body == 0);
  }
}

PathModel::PathModel(const SkeletonModel& skeleton, int joint)
    : joint_(joint), tree_(std::make_shared<KinematicTree>(skeleton)) {
  const JointModel& model = skeleton.joints[joint];
  obstacles_.resize(2);
  obstacles_[0].body = model.parent;
  obstacles_[0].point_B =
      skeleton.bodies[model.parent].X_LB.inverse() * (model.X_PC_rest * model.center_C);
  obstacles_[1].body = model.child;
  obstacles_[1].point_B = skeleton.bodies[model.child].X_LB.inverse() * model.center_C;
  state_offsets_ = {0, 0};
  state_size_ = 1;  // the last position, for whole turns
  joints_ = {{{joint, 1.0}}};
  static_ = {false};
}

/// Neighbours on the surface's own body do not move in its frame.
void PathModel::prepare_surface(std::size_t i) {
  if (!obstacles_[i].surface) return;
  const auto fixed = [&](const PathObstacle& point) {
    return !point.surface && point.body == obstacles_[i].body ? &point.point_B : nullptr;
  };
  auto prepared =
      obstacles_[i].surface->prepared_for(fixed(obstacles_[i - 1]), fixed(obstacles_[i + 1]));
  if (prepared) obstacles_[i].surface = std::move(prepared);
}

MusclePath::MusclePath(const PathModel& model)
    : model_(model),
      segments_(model.segment_count()),
      obstacles_(model.obstacles().size()),
      contacts_(model.obstacles().size()) {}

void MusclePath::initialise(const std::vector<BodyState>& bodies, StateView state) {
  const auto& list = model_.obstacles();
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    if (model_.is_static(i)) update_point_segment(bodies, i);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].surface) continue;
    const Pose& X_WB = bodies[list[i].body].X_WB;
    const Vec3 before = X_WB.to_local(bodies[list[i - 1].body].X_WB * list[i - 1].point_B);
    const Vec3 after = X_WB.to_local(bodies[list[i + 1].body].X_WB * list[i + 1].point_B);
    list[i].surface->initialise(before, after, state.from(model_.state_offset(i)));
  }
  update(bodies, state);
}

void MusclePath::update(const std::vector<BodyState>& bodies, StateView state) {
  if (model_.joint() >= 0) return update_drive(bodies, state);
  const auto& list = model_.obstacles();
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].surface) {
      update_surface(bodies, state, i);
    } else if (i + 1 < list.size() && !list[i + 1].surface && !model_.is_static(i)) {
      update_point_segment(bodies, i);
    }
  }
  length_ = 0.0;
  bool all_long = true;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    length_ += segments_[i].length + obstacles_[i].length_on;
    all_long = all_long && segments_[i].length > kNoLength;
  }
  if (!all_long) direct_short_segments();
  for (std::size_t i = 1; i + 1 < list.size(); ++i) {
    if (list[i].surface ||
        (model_.is_static(i - 1) && model_.is_static(i) && obstacles_[i].turning > 0)) {
      continue;
    }
    obstacles_[i].turning = angle_between(segments_[i - 1].direction_W, segments_[i].direction_W);
  }
}

void MusclePath::update_point_segment(const std::vector<BodyState>& bodies, std::size_t i) {
  const PathObstacle &a = model_.obstacles()[i], &b = model_.obstacles()[i + 1];
  PathSegment& segment = segments_[i];
  segment.from_W = bodies[a.body].X_WB * a.point_B;
  segment.to_W = bodies[b.body].X_WB * b.point_B;
  const Vec3 line = segment.to_W - segment.from_W;
  segment.length = line.norm();
  // Coincident points pull nowhere; any direction serves.
  segment.direction_W = segment.length > 0.0 ? Vec3(line / segment.length) : Vec3(Vec3::UnitX());
  segment.pull_W = segment.direction_W;
}

void MusclePath::update_drive(const std::vector<BodyState>& bodies, StateView state) {
  update_point_segment(bodies, 0);
  state[0] = model_.tree()->position(model_.joint(), bodies, state[0]);
  length_ = -state[0];
}

/// Whether both ends of the piece between two points, to which a segment belongs, are one place.
bool MusclePath::has_no_length(std::size_t i) const {
  const auto& list = model_.obstacles();
  double length = segments_[i].length;
  for (const std::size_t end : {i, i + 1}) {
    if (!list[end].surface) continue;
    if (obstacles_[end].touching) return false;
    length += segments_[end == i ? i - 1 : i + 1].length;
  }
  return length <= kNoLength;
}

/// Segments without length take their neighbour's direction, so that the tendon turns there once,
/// by what the segments beside them turn.
void MusclePath::direct_short_segments() {
  const std::size_t count = segments_.size();
  std::size_t first = 0;
  while (first < count && has_no_length(first)) ++first;
  if (first == count) return;
  const auto follow = [this](std::size_t i, std::size_t neighbour) {
    segments_[i].direction_W = segments_[i].pull_W = segments_[neighbour].direction_W;
  };
  for (std::size_t i = 0; i < first; ++i) follow(i, first);
  for (std::size_t i = first + 1; i < count; ++i) {
    if (has_no_length(i)) follow(i, i - 1);
  }
}

void MusclePath::update_surface(const std::vector<BodyState>& bodies, StateView state,
                                std::size_t i) {
  const auto& list = model_.obstacles();
  const Pose& X_WB = bodies[list[i].body].X_WB;
  const Vec3 before_W = bodies[list[i - 1].body].X_WB * list[i - 1].point_B;
  const Vec3 after_W = bodies[list[i + 1].body].X_WB * list[i + 1].point_B;
  WrapContact& contact = contacts_[i];
  list[i].surface->wrap(X_WB.to_local(before_W), X_WB.to_local(after_W),
                        state.from(model_.state_offset(i)), contact);
  segments_[i - 1] = {before_W, X_WB * contact.entry, X_WB.R * contact.direction_in,
                      X_WB.R * contact.pull_in, contact.length_in};
  segments_[i] = {X_WB * contact.exit, after_W, X_WB.R * contact.direction_out,
                  X_WB.R * contact.pull_out, contact.length_out};
  obstacles_[i] = {contact.touching,   contact.length_on,  contact.turning,
                   contact.wrap_angle, contact.half_turns, contact.penetration};
}

void MusclePath::add_moment_arms(std::size_t i, double scale, const KinematicTree& tree,
                                 double* target) const {
  if (model_.joint() >= 0) {
    target[tree.model().joints[model_.joint()].velocity_offset] += scale;
    return;
  }
  const PathSegment& segment = segments_[i];
  for (const JointOnPath& step : model_.joints_of_segment(i)) {
    const JointModel& joint = tree.model().joints[step.joint];
    const KinematicTree::JointView& view = tree.joint(step.joint);
    const double weight = -scale * step.sign;
    double* arm = target + joint.velocity_offset;
    if (joint.type == JointType::kPrismatic) {
      arm[0] += weight * view.axis_W.dot(segment.pull_W);
      continue;
    }
    // The line of action may be taken at either end; the far end lies beyond the joint.
    const Vec3& point = step.sign > 0 ? segment.to_W : segment.from_W;
    const Vec3 moment = (point - view.center_W).cross(segment.pull_W);
    if (joint.type == JointType::kHinge) {
      arm[0] += weight * view.axis_W.dot(moment);
    } else {
      arm[0] += weight * moment[0];
      arm[1] += weight * moment[1];
      arm[2] += weight * moment[2];
    }
  }
}

std::vector<CarriedPoint> MusclePath::carried_points() const {
  const auto& list = model_.obstacles();
  std::vector<CarriedPoint> points;
  std::vector<Vec3> on_surface;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!list[i].surface) {
      points.push_back({list[i].body, list[i].point_B});
    } else if (contacts_[i].touching) {
      on_surface.clear();
      list[i].surface->trace(contacts_[i], on_surface);
      for (const Vec3& point : on_surface) points.push_back({list[i].body, point});
    }
  }
  return points;
}

std::vector<Vec3> MusclePath::polyline(const std::vector<BodyState>& bodies) const {
  std::vector<Vec3> points;
  for (const CarriedPoint& point : carried_points()) {
    points.push_back(bodies[point.body].X_WB * point.point_B);
  }
  return points;
}

}  // namespace anthrob
