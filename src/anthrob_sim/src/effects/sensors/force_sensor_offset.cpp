#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "force_sensor_offset";
  i.name = "Force sensor offset and drift";
  i.description =
      "The reading of a force sensor is wrong by a constant that may grow with time: only its "
      "channel disagrees; joint and current agree. The controller sees the error, too. Time counts "
      "from where the robot is placed (reset, start of a replay's settling).";
  i.equation = "f_read = f + offset + drift t";
  i.source = "known: 0.5-5 N";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSensors;
  i.channels = {"force"};
  i.parameters = {{"offset", "N", "constant error", 0.0, 1.0, {-50.0, 50.0}},
                  {"drift", "N/s", "growth of the offset with time", 0.0, 0.01, {-1.0, 1.0}}};
  return i;
}

class Offset final : public ReadingEffect {
 public:
  Offset(std::size_t muscle, double offset, double drift, double step)
      : muscle_(muscle), offset_(offset), drift_(drift * step) {}
  std::size_t state_size() const override { return 1; }
  void reset(const Readings&, StateView state) const override { state[0] = 0.0; }
  void apply(Readings& readings, StateView state) const override {
    readings.muscles[muscle_].force += offset_ + drift_ * state[0];
    state[0] += 1.0;
  }

 private:
  std::size_t muscle_;
  double offset_;
  double drift_;  ///< a step [N]
};

class ForceSensorOffset final : public MuscleEffect {
 public:
  ForceSensorOffset() : MuscleEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.reading_effects.push_back(
        std::make_shared<Offset>(muscle, setting["offset"], setting["drift"], draft.robot.step));
  }
};

const EffectRegistration kRegistration(std::make_unique<ForceSensorOffset>());

}  // namespace
}  // namespace anthrob
