#pragma once

#include <memory>
#include <vector>

#include "anthrob_sim/skeleton/kinematic_tree.h"

namespace anthrob {

/// The rigid bodies in Bullet, in body space (3.1)-(3.5), double precision, gyroscopic term on.
/// One step: applied wrenches and gravity -> joint constraints (and contacts, if any body has a
/// collision shape) -> new poses.
class Skeleton {
 public:
  /// @param gravity [m/s^2], world
  /// @param step [s], > 0
  Skeleton(const SkeletonModel& model, const Vec3& gravity, double step, bool collisions);
  ~Skeleton();

  /// Motion of all bodies; 0 is the world.
  const std::vector<BodyState>& bodies() const { return bodies_; }
  /// Sets the motion of all bodies. Also restores a snapshot, bit for bit.
  void set_bodies(const std::vector<BodyState>& bodies);

  void clear_wrenches();
  /// @param force_W [N] at the centre of mass, @param torque_W [Nm]
  void add_wrench(int body, const Vec3& force_W, const Vec3& torque_W) {
    forces_[body] += force_W;
    torques_[body] += torque_W;
  }

  /// Applied to a body's centre of mass in this step, without gravity [N].
  const Vec3& force(int body) const { return forces_[body]; }

  void step();

 private:
  struct Bullet;

  const SkeletonModel& model_;
  Vec3 gravity_;
  double step_;
  std::vector<BodyState> bodies_;
  std::vector<Vec3> forces_, torques_;
  std::unique_ptr<Bullet> bullet_;
};

}  // namespace anthrob
