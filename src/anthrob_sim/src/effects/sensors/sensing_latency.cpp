#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"
#include "core/delay_line.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "sensing_latency";
  i.name = "Sensing latency";
  i.description =
      "Sampling, filters and bus delay what an ECU measures: a phase lag that grows with "
      "frequency and no static error. All channels of the muscle; the controller acts on the "
      "delayed readings, too.";
  i.equation = "y_read(t) = y(t - delay), y = position, velocity, current, force";
  i.source = "known: 1-20 ms";
  i.where = "MUSCLE | all";
  i.seam = Seam::kSensors;
  i.channels = {"position", "velocity", "current", "force"};
  i.parameters = {{"delay", "s", "of readings", 0.0, 0.005, {0.0, 0.2}}};
  return i;
}

class Latency final : public ReadingEffect {
 public:
  Latency(std::size_t muscle, double delay, double step)
      : muscle_(muscle), delay_(delay), line_(delay, state_size_of<ecu::Measurement>(), step) {}

  std::size_t state_size() const override { return line_.state_size(); }
  void reset(const Readings& readings, StateView state) const override {
    line_.fill(signals(readings), state);
  }
  void apply(Readings& readings, StateView state) const override {
    line_.push(signals(readings), state);
    for (std::size_t i = 0; i < state_size_of<ecu::Measurement>(); ++i) {
      signals(readings)[i] = line_.blended(i, state);
    }
  }
  double position_delay(std::size_t muscle) const override {
    return muscle == muscle_ ? delay_ : 0.0;
  }

 private:
  double* signals(const Readings& readings) const { return &readings.muscles[muscle_].position; }

  std::size_t muscle_;
  double delay_;
  DelayLine line_;
};

class SensingLatency final : public MuscleEffect {
 public:
  SensingLatency() : MuscleEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t muscle) const override {
    draft.robot.reading_effects.push_back(
        std::make_shared<Latency>(muscle, setting["delay"], draft.robot.step));
  }
};

const EffectRegistration kRegistration(std::make_unique<SensingLatency>());

}  // namespace
}  // namespace anthrob
