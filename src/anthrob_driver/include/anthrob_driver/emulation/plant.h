#pragma once

#include <cstddef>

namespace anthrob {
namespace driver {

/// What emulated ECUs are wired to: motors, tendons and sensors of a simulated robot. Its values
/// are exact; the boards turn them into counts.
class Plant {
 public:
  struct Muscle {
    double position = 0.0;  ///< [rad] at the gear output, winding in positive
    double current = 0.0;   ///< [A]
    double force = 0.0;     ///< [N] at the force sensor
  };

  virtual ~Plant() = default;
  /// @param muscle index in Hardware::muscles
  virtual Muscle muscle(std::size_t muscle) const = 0;
  /// @param joint index in Hardware::joints   @return [rad]
  virtual double joint(std::size_t joint) const = 0;
  /// @param pad index in Hardware::touch   @return [N]
  virtual double touch(std::size_t pad) const = 0;
  /// Voltage of the power stage from now on.
  virtual void drive(std::size_t muscle, double voltage) = 0;
  /// One millisecond passes.
  virtual void advance() = 0;
};

}  // namespace driver
}  // namespace anthrob
