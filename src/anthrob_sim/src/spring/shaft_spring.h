#pragma once

#include <cmath>

#include "anthrob_sim/spring/series_elastic_element.h"

namespace anthrob {

/// The shaft of a drive at rest: a linear spring that pushes as it pulls, or none at all. In motion
/// its torque is found together with that of motor and joint: see muscle/motor_shaft.h.
class ShaftSpring final : public SeriesElasticElement {
 public:
  /// @param stiffness [Nm/rad, N/m], infinite: rigid   @param damping [Nms/rad, Ns/m]
  /// @param backlash [rad, m]
  ShaftSpring(double stiffness, double damping, double backlash)
      : stiffness_(stiffness), damping_(damping), play_(0.5 * backlash) {}

  std::size_t state_size() const override { return 1; }
  double rest_length() const override { return 0.0; }
  void relax(double twist, StateView state) const override { state[0] = twist; }
  double advance(double twist, StateView state) const override {
    state[0] = twist;
    return relaxed_tension(twist);
  }
  double relaxed_tension(double twist) const override {
    return std::isfinite(stiffness_) ? stiffness_ * bent(twist) : 0.0;
  }
  double relaxed_expansion(double torque) const override {
    return torque == 0.0 ? 0.0 : torque / stiffness_ + std::copysign(play_, torque);
  }
  double stored_energy(StateView state) const override {
    return 0.5 * relaxed_tension(state[0]) * bent(state[0]);
  }
  double dissipation(double rate, StateView state) const override {
    return bent(state[0]) == 0.0 ? 0.0 : damping_ * rate * rate;
  }

 private:
  double bent(double twist) const {
    return std::copysign(std::fmax(0.0, std::abs(twist) - play_), twist);
  }

  double stiffness_, damping_, play_;
};

}  // namespace anthrob
