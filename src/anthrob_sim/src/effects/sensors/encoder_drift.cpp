#include <cmath>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "encoder_drift";
  i.name = "Encoder drift";
  i.description =
      "Counts get lost with time or with every turn: the measured position drifts away from the "
      "true one, and under position control the robot drifts away from its posture. Force and "
      "current still agree. The drift starts at zero where the robot is placed (reset, start of a "
      "replay's settling).";
  i.equation = "position_read = position + rate t - missed integral |dposition|";
  i.source =
      "thesis, section 8.3: ticks counted in software; re-calibrated when the shoulder rested 3 "
      "degrees off";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSensors;
  i.slow = true;
  i.channels = {"position", "joint", "force"};
  i.parameters = {
      {"rate", "rad/s", "drift with time", 0.0, 2e-3, {-0.1, 0.1}},
      {"missed", "1", "counts lost, share of the angle travelled", 0.0, 0.005, {0.0, 0.5}},
  };
  return i;
}

class Drift final : public ReadingEffect {
 public:
  Drift(std::size_t muscle, double rate, double missed, double step)
      : muscle_(muscle), rate_(rate * step), missed_(missed) {}

  std::size_t state_size() const override { return state_size_of<Own>(); }
  void reset(const Readings& readings, StateView state) const override {
    state.as<Own>() = {0.0, 0.0, readings.muscles[muscle_].position};
  }
  void apply(Readings& readings, StateView state) const override {
    double& position = readings.muscles[muscle_].position;
    Own& s = state.as<Own>();
    s.travelled += std::abs(position - s.last);
    s.last = position;
    position += rate_ * s.steps - missed_ * s.travelled;
    s.steps += 1.0;
  }
  double true_position(std::size_t muscle, double position, StateView state) const override {
    if (muscle != muscle_) return position;
    const Own& s = state.as<Own>();
    const double moved = position - rate_ * s.steps + missed_ * s.travelled - s.last;
    return s.last + moved / (1.0 - std::copysign(missed_, moved));
  }

 private:
  struct Own {
    double steps;
    double travelled, last;  ///< [rad]
  };
  std::size_t muscle_;
  double rate_;  ///< a step [rad]
  double missed_;
};

class EncoderDrift final : public MuscleEffect {
 public:
  EncoderDrift() : MuscleEffect(describe()) {}

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.motor() != nullptr; }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.reading_effects.push_back(
        std::make_shared<Drift>(muscle, setting["rate"], setting["missed"], draft.robot.step));
  }
};

const EffectRegistration kRegistration(std::make_unique<EncoderDrift>());

}  // namespace
}  // namespace anthrob
