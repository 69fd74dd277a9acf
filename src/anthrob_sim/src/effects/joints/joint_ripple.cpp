#include <cmath>
#include <string>

#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

/// Harmonics of one joint. Where more than these show, the strongest are taken.
constexpr int kHarmonics = 12;

std::string numbered(const char* name, int k) {
  return name + ("_" + std::to_string(k));
}

EffectInfo describe() {
  EffectInfo i;
  i.id = "joint_ripple";
  i.name = "Position-dependent joint torque (ripple)";
  i.description =
      "A conservative torque that repeats along the joint's way: cogging of a direct drive or of a "
      "linear motor, eccentric gears, balls of a bearing. A Fourier series of up to 12 terms: "
      "periods_k counts the repetitions in a turn (on a slide in a metre), and sine_k and cosine_k "
      "give amplitude and phase. Terms without size are left out. Discovery takes the periods from "
      "the data, of a driven joint. In each step acts the mean over the way that the joint is "
      "about "
      "to make, so fast motion averages it out.";
  i.equation = "tau = sum_k sine_k sin(periods_k q) + cosine_k cos(periods_k q)";
  i.source = "Fourier; cogging: Hanselman 2003, Brushless Permanent Magnet Motor Design";
  i.where = "JOINT (hinges and slides)";
  i.seam = Seam::kJoints;
  i.stage = Stage::kComponents;
  i.channels = {"joint", "force"};
  for (int k = 1; k <= kHarmonics; ++k) {
    i.parameters.push_back({numbered("periods", k),
                            "1/turn",
                            "repetitions",
                            static_cast<double>(k),
                            static_cast<double>(k),
                            {0.0, 1e4, true},
                            EffectParameter::kGiven});
    i.parameters.push_back(
        {numbered("sine", k), "Nm", "part that is 0 at position 0", 0.0, 0.02, {-1e6, 1e6}});
    i.parameters.push_back(
        {numbered("cosine", k), "Nm", "the torque at position 0", 0.0, 0.02, {-1e6, 1e6}});
  }
  return i;
}

class RippleTorque final : public JointTorque {
 public:
  RippleTorque(const JointModel& joint, double step)
      : position_(joint.position_offset), dof_(joint.velocity_offset), step_(step) {}

  /// @param wave_number phase per position [rad/rad, rad/m]
  void add_harmonic(double wave_number, double sine, double cosine) {
    harmonics_.push_back({wave_number, std::hypot(sine, cosine), std::atan2(cosine, sine)});
  }

  void add(const KinematicTree& tree, const std::vector<double>& q, double* tau) const override {
    const double way = step_ * tree.velocities()[static_cast<std::size_t>(dof_)];
    for (const Harmonic& h : harmonics_) {
      // Mean of sin over the way: sin of the middle times sin(x) / x of half of it.
      const double half = 0.5 * h.wave_number * way;
      const double middle = h.wave_number * q[static_cast<std::size_t>(position_)] + h.phase + half;
      const double left = std::abs(half) < 1e-6 ? 1.0 : std::sin(half) / half;
      tau[dof_] += h.amplitude * left * std::sin(middle);
    }
  }
  double energy(const std::vector<double>& q) const override {
    double sum = 0.0;
    for (const Harmonic& h : harmonics_) {
      sum += h.amplitude / h.wave_number *
             std::cos(h.wave_number * q[static_cast<std::size_t>(position_)] + h.phase);
    }
    return sum;
  }

 private:
  struct Harmonic {
    double wave_number, amplitude, phase;
  };
  int position_, dof_;
  double step_;
  std::vector<Harmonic> harmonics_;
};

class JointRipple final : public JointEffect {
 public:
  JointRipple() : JointEffect(describe()) {}

 protected:
  bool fits(const JointModel& joint) const override { return joint.type != JointType::kBall; }
  void change(const EffectSetting& setting, ModelDraft& draft, JointModel& joint) const override {
    const double per_period = joint.type == JointType::kHinge ? 1.0 : 2.0 * M_PI;
    auto torque = std::make_shared<RippleTorque>(joint, draft.robot.step);
    for (int k = 1; k <= kHarmonics; ++k) {
      const double sine = setting[numbered("sine", k)], cosine = setting[numbered("cosine", k)];
      if (sine == 0.0 && cosine == 0.0) continue;
      torque->add_harmonic(per_period * setting[numbered("periods", k)], sine, cosine);
    }
    draft.robot.joint_torques.push_back(std::move(torque));
  }
};

const EffectRegistration kRegistration(std::make_unique<JointRipple>());

}  // namespace
}  // namespace anthrob
