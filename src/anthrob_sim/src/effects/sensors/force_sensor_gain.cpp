#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "force_sensor_gain";
  i.name = "Force sensor gain error";
  i.description =
      "The reading of a force sensor is wrong by a constant factor: only its channel disagrees, in "
      "proportion to force. The controller sees the error, too.";
  i.equation = "f_read = gain f";
  i.source = "known: 1-5 %";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSensors;
  i.channels = {"force"};
  i.parameters = {{"gain", "1", "measured force over true force", 1.0, 1.03, {0.5, 2.0}}};
  return i;
}

class Gain final : public ReadingEffect {
 public:
  Gain(std::size_t muscle, double gain) : muscle_(muscle), gain_(gain) {}
  void apply(Readings& readings, StateView) const override {
    readings.muscles[muscle_].force *= gain_;
  }

 private:
  std::size_t muscle_;
  double gain_;
};

class ForceSensorGain final : public MuscleEffect {
 public:
  ForceSensorGain() : MuscleEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.reading_effects.push_back(std::make_shared<Gain>(muscle, setting["gain"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<ForceSensorGain>());

}  // namespace
}  // namespace anthrob
