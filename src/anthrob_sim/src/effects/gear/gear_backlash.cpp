#include <algorithm>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "gear_backlash";
  i.name = "Backlash between gear and spindle";
  i.description =
      "The spindle has play relative to the gear's output, where the encoder sits. The tendon "
      "pulls the spindle against the flank that winds in; the plain model has it there all the "
      "time. Below a small torque the spindle's own drag holds it: when the motor turns back, the "
      "encoder moves and the tendon does not, until the other flank takes the spindle along. "
      "Between the flanks the motor carries no load. At both flanks everything is as in the plain "
      "model, whose friction of motor and gear is assumed to include the drag. If that friction is "
      "less than the drag, a motor at the other flank unwinds under the tendon as in the plain "
      "model. Under pretension the play has no effect. Of a drive, whose motor also pushes, the "
      "play "
      "lies between gear and joint, and neither turns the other between its flanks.";
  i.equation =
      "position <= spindle <= position + width; free: d spindle/dt = -max(0, f r_S - drag) / "
      "(drag 0.1 s)";
  i.source = "play operator with a dry bearing; own model, because a tendon only pulls";
  i.where = "MUSCLE | all";
  i.once_a_muscle = true;
  i.seam = Seam::kGear;
  i.dissipates = true;
  i.channels = {"position", "force", "current"};
  i.parameters = {
      {"width", "rad", "of the play, at the output", 0.0, 0.02, {0.0, 0.5}},
      {"drag",
       "Nm",
       "torque of the tendon that the spindle resists",
       0.01,
       0.04,
       {1e-4, 1.0},
       EffectParameter::kShape},
  };
  return i;
}

class LooseSpindle final : public MotorWrapper {
 public:
  LooseSpindle(std::shared_ptr<const GearedMotor> motor, double width, double drag, double step)
      : MotorWrapper(std::move(motor)), width_(width), drag_(drag), step_(step) {}

  std::size_t state_size() const override { return inner().state_size() + state_size_of<Own>(); }
  void place(double position, StateView state) const override {
    inner().place(position, state);
    own(state).as<Own>() = {0.0, inner().winding_speed(state)};
  }
  void impose(double position, double velocity, double load, StateView state) const override {
    const double before = inner().read(state).position;
    inner().impose(position, velocity, load, state);
    follow(before, load, state);
  }
  void advance_with(double input, double load, double torque, StateView state) const override {
    const double before = inner().read(state).position;
    const double lead = own(state).as<Own>().lead;
    const bool free = lead > 0.0 && lead < width_;
    inner().advance_with(input, free ? 0.0 : load, torque, state);
    follow(before, load, state);
  }
  double tendon_length(StateView state) const override {
    return inner().tendon_length(state) - spindle_radius() * own(state).as<Own>().lead;
  }
  double winding_speed(StateView state) const override { return own(state).as<Own>().speed; }

 private:
  struct Own {
    double lead;   ///< of the spindle before the flank that winds in, 0 to width [rad]
    double speed;  ///< at which the tendon is wound in [m/s]
  };

  void follow(double before, double load, StateView state) const {
    Own& s = own(state).as<Own>();
    const double turned = inner().read(state).position - before;
    const double excess = std::max(0.0, load * spindle_radius() - drag_);
    const double slid = step_ * excess / (drag_ * kSlowness);
    const double lead = std::clamp(s.lead - turned - slid, 0.0, width_);
    s.speed = lead == 0.0 && s.lead == 0.0 ? inner().winding_speed(state)
                                           : spindle_radius() * (turned + lead - s.lead) / step_;
    s.lead = lead;
  }

  static constexpr double kSlowness = 0.1;  ///< [s/rad] for an excess as large as the drag
  double width_, drag_, step_;
};

class GearBacklash final : public MotorWrappingEffect {
 public:
  GearBacklash() : MotorWrappingEffect(describe()) {}

 protected:
  void change(const EffectSetting& setting, ModelDraft& draft, std::size_t index) const override {
    MuscleModel& muscle = draft.robot.muscles[index];
    if (!muscle.is_drive()) return MotorWrappingEffect::change(setting, draft, index);
    Transmission loose = *muscle.transmission;
    loose.backlash += setting["width"] * muscle.motor()->spindle_radius();
    muscle.transmit(loose);
  }
  std::shared_ptr<const Actuator> wrap(const EffectSetting& setting,
                                       std::shared_ptr<const GearedMotor> motor,
                                       double step) const override {
    return std::make_shared<LooseSpindle>(std::move(motor), setting["width"], setting["drag"],
                                          step);
  }
};

const EffectRegistration kRegistration(std::make_unique<GearBacklash>());

}  // namespace
}  // namespace anthrob
