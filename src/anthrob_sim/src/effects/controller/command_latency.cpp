#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "command_latency";
  i.name = "Command latency";
  i.description =
      "Bus, driver and controller take time before a command acts: a phase lag that grows with "
      "frequency and no static error. Between two steps the reference is interpolated, and the "
      "mode switches at once.";
  i.equation = "reference_ecu(t) = reference(t - delay)";
  i.source = "known: 1-20 ms";
  i.where = "MUSCLE | all";
  i.seam = Seam::kController;
  i.stage = Stage::kNumbers;
  i.channels = {"voltage", "position", "force", "joint"};
  i.parameters = {{"delay", "s", "of commands", 0.0, 0.005, {0.0, 0.2}}};
  return i;
}

class CommandLatency final : public MuscleEffect {
 public:
  CommandLatency() : MuscleEffect(describe()) {}

 protected:
  bool fits(const MuscleModel& muscle) const override { return muscle.actuator->takes_input(); }
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.muscles[muscle].command_delay += setting["delay"];
  }
};

const EffectRegistration kRegistration(std::make_unique<CommandLatency>());

}  // namespace
}  // namespace anthrob
