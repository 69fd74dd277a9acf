#include <algorithm>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "mocap_misalignment";
  i.name = "Misaligned motion capture frame";
  i.description =
      "The frame of motion capture is rotated about an axis of the world: the measured orientation "
      "of a body relative to the base is wrong by one constant rotation. Joints between two moving "
      "bodies are measured correctly, because both bodies have the same error.";
  i.equation = "R_read = R(axis, angle) R, of ball joints on the base";
  i.source = "known: 1-5 degrees";
  i.where = "x | y | z";
  i.seam = Seam::kSensors;
  i.channels = {"joint"};
  i.parameters = {
      {"angle", "rad", "rotation of the measured orientations", 0.0, 0.03, {-0.5, 0.5}}};
  return i;
}

class TurnedReadings final : public ReadingEffect {
 public:
  TurnedReadings(const SkeletonModel& skeleton, const Vec3& axis_W, double angle) {
    for (const JointModel& joint : skeleton.joints) {
      if (joint.parent != 0 || joint.type != JointType::kBall) continue;
      // R_WC = R_rest R(q): the turn in the axes of the child at rest.
      const Vec3 axis = joint.X_PC_rest.R.transpose() * axis_W;
      balls_.push_back({joint.position_offset, Quat(Eigen::AngleAxisd(angle, axis))});
    }
  }
  void apply(Readings& readings, StateView) const override {
    for (const Ball& ball : balls_) turn(ball.turn, readings.positions + ball.offset);
  }
  void true_joint_positions(double* positions) const override {
    for (const Ball& ball : balls_) turn(ball.turn.conjugate(), positions + ball.offset);
  }

 private:
  struct Ball {
    int offset;
    Quat turn;
  };
  static void turn(const Quat& by, double* q) {
    const Quat turned = canonical(by * Quat(q[0], q[1], q[2], q[3]));
    q[0] = turned.w(), q[1] = turned.x(), q[2] = turned.y(), q[3] = turned.z();
  }

  std::vector<Ball> balls_;
};

class MocapMisalignment final : public WorldAxisEffect {
 public:
  MocapMisalignment() : WorldAxisEffect(describe()) {}

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    draft.robot.reading_effects.push_back(std::make_shared<TurnedReadings>(
        draft.skeleton, axis_of(setting.place()), setting["angle"]));
  }

 protected:
  bool fits(const RobotModel& robot, const Vec3&) const override {
    const auto& joints = robot.skeleton->joints;
    return std::any_of(joints.begin(), joints.end(), [](const JointModel& joint) {
      return joint.parent == 0 && joint.type == JointType::kBall;
    });
  }
};

const EffectRegistration kRegistration(std::make_unique<MocapMisalignment>());

}  // namespace
}  // namespace anthrob
