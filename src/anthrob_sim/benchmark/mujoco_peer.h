#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// The robot as a MuJoCo model, as close as MuJoCo can express it: bodies, joints, damping, limits,
/// tendons over the same points, cylinders and spheres, each with a linear spring of the ring's
/// stiffness and one force actuator. What MuJoCo lacks stays out: motors, gears, viscoelastic
/// state, tendon friction.
std::string to_mjcf(const RobotModel& model);

/// A compiled MuJoCo model with its data.
class MujocoPeer {
 public:
  explicit MujocoPeer(const RobotModel& model);
  void step() { mj_step(model_.get(), data_.get()); }
  mjModel& model() { return *model_; }
  mjData& data() { return *data_; }

 private:
  struct Deleter {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Deleter> model_;
  std::unique_ptr<mjData, Deleter> data_;
};

}  // namespace anthrob
