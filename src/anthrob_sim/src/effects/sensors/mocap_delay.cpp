#include <cmath>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "core/delay_line.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "mocap_delay";
  i.name = "Motion capture delay";
  i.description =
      "Positions and velocities of all joints are stamped too late: only motion capture "
      "disagrees, with a phase lag that grows with frequency.";
  i.equation = "q_read(t) = q(t - delay)";
  i.source = "known: some ms";
  i.where = "global";
  i.seam = Seam::kSensors;
  i.channels = {"joint"};
  i.parameters = {{"delay", "s", "of joint readings", 0.0, 0.01, {0.0, 0.2}}};
  return i;
}

class JointDelay final : public ReadingEffect {
 public:
  JointDelay(const SkeletonModel& skeleton, double delay, double step)
      : count_(static_cast<std::size_t>(skeleton.position_count + skeleton.velocity_count)),
        delay_(delay),
        line_(delay, count_, step) {
    for (const JointModel& joint : skeleton.joints) {
      if (joint.type == JointType::kBall) balls_.push_back(joint.position_offset);
    }
  }

  std::size_t state_size() const override { return line_.state_size(); }
  void reset(const Readings& readings, StateView state) const override {
    line_.fill(readings.positions, state);
  }
  /// Velocities lie behind the positions.
  void apply(Readings& readings, StateView state) const override {
    line_.push(readings.positions, state);
    for (std::size_t i = 0; i < count_; ++i) readings.positions[i] = line_.blended(i, state);
    for (const int ball : balls_) blend_turn(readings.positions + ball, ball, state);
  }

  double joint_delay() const override { return delay_; }

 private:
  /// Between two orientations; where their signs differ, the nearer one will do.
  void blend_turn(double* q, int offset, StateView state) const {
    double norm = 0.0;
    for (int k = 0; k < 4; ++k) norm += q[k] * q[k];
    norm = std::sqrt(norm);
    for (int k = 0; k < 4; ++k) {
      q[k] = norm > 0.9 ? q[k] / norm : line_.nearest(static_cast<std::size_t>(offset + k), state);
    }
  }

  std::size_t count_;
  double delay_;
  DelayLine line_;
  std::vector<int> balls_;
};

class MocapDelay final : public GlobalEffect {
 public:
  MocapDelay() : GlobalEffect(describe()) {}

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    draft.robot.reading_effects.push_back(
        std::make_shared<JointDelay>(draft.skeleton, setting["delay"], draft.robot.step));
  }
};

const EffectRegistration kRegistration(std::make_unique<MocapDelay>());

}  // namespace
}  // namespace anthrob
