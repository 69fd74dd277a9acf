#pragma once

#include <vector>

#include "anthrob_driver/emulation/plant.h"
#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

/// A test bench without robot or simulator: every muscle is a DC motor with a gear that winds in a
/// tendon with a spring whose other end is fixed. Enough to try a bus, a controller and every
/// fault.
///   V = R i + K N w,   J N^2 dw/dt = K N i - r f,   f = max(0, k r (position - slack))
class TendonPlant final : public Plant {
 public:
  struct Parameters {
    double resistance = 0.79;   ///< R, power stage included [ohm]
    double constant = 0.0115;   ///< K [Nm/A, Vs/rad]
    double ratio = 128.0;       ///< N
    double inertia = 1.09e-6;   ///< J [kg m^2]
    double damping = 2e-6;      ///< of the motor shaft [Nms/rad]
    double radius = 0.0065;     ///< r of the spindle [m]
    double stiffness = 4000.0;  ///< k of tendon and spring [N/m]
    double slack = 0.0;         ///< position at which the tendon gets tight [rad]
  };

  TendonPlant(std::size_t muscles, std::size_t joints, std::size_t pads)
      : TendonPlant(muscles, joints, pads, Parameters{}) {}
  TendonPlant(std::size_t muscles, std::size_t joints, std::size_t pads,
              const Parameters& parameters);
  /// With the windings of this robot's motors where they are known, otherwise those of the bench.
  explicit TendonPlant(const Hardware& hardware);

  Muscle muscle(std::size_t muscle) const override;
  double joint(std::size_t joint) const override { return joints_[joint]; }
  double touch(std::size_t pad) const override { return pads_[pad]; }
  void drive(std::size_t muscle, double voltage) override {
    tendons_[muscle].voltage = tendons_[muscle].reversed ? -voltage : voltage;
  }
  void advance() override;

  double voltage(std::size_t muscle) const { return tendons_[muscle].voltage; }
  /// For tests: the tendon breaks (cut); it is tight only from `position` on (slacken); the spindle
  /// is stuck (jam).
  void cut(std::size_t muscle) { tendons_[muscle].cut = true; }
  void slacken(std::size_t muscle, double position) { tendons_[muscle].slack = position; }
  void jam(std::size_t muscle) { tendons_[muscle].jammed = true; }
  /// Its spindle is turned by hand, at once.
  void turn(std::size_t muscle, double position) { tendons_[muscle].position = position; }
  /// Its motor's leads are swapped.
  void reverse(std::size_t muscle) { tendons_[muscle].reversed = true; }
  void set_joint(std::size_t joint, double position) { joints_[joint] = position; }
  void set_touch(std::size_t pad, double force) { pads_[pad] = force; }

 private:
  struct Tendon {
    double voltage = 0.0, current = 0.0, velocity = 0.0, position = 0.0, slack = 0.0;
    double resistance = 0.0, back_emf = 0.0;  ///< [ohm], [Vs/rad] at the gear output
    bool cut = false, jammed = false, reversed = false;
  };
  double force(const Tendon& tendon) const;

  Parameters p_;
  std::vector<Tendon> tendons_;
  std::vector<double> joints_, pads_;
};

}  // namespace driver
}  // namespace anthrob
