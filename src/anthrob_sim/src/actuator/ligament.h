#pragma once

#include "anthrob_sim/actuator/actuator.h"

namespace anthrob {

/// No actuator: a tendon of constant length (section 4.6, ligaments).
class Ligament final : public Actuator {
 public:
  explicit Ligament(double length) : length_(length) {}

  std::size_t state_size() const override { return 0; }
  void place(double, StateView) const override {}
  void impose(double, double, double, StateView) const override {}
  void advance(double, double, StateView) const override {}
  Readout read(StateView) const override { return {0.0, 0.0, 0.0}; }
  double tendon_length(StateView) const override { return length_; }
  double winding_speed(StateView) const override { return 0.0; }
  double position_for(double) const override { return 0.0; }
  double holding_input(double, double) const override { return 0.0; }
  double input_low() const override { return 0.0; }
  double input_high() const override { return 0.0; }

  static std::shared_ptr<const Actuator> load(const ConfigNode& kind, const ConfigNode& muscle,
                                              double step);

 private:
  double length_;
};

}  // namespace anthrob
