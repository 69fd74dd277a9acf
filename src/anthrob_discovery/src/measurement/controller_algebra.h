#pragma once

#include <array>
#include <optional>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/measurement.h"

namespace anthrob {
namespace discovery {

/// What of a recording was stamped late.
enum class LateStamp { kVoltage, kPosition, kForce, kReference, kMeasured };

/// A shift of stamps by which recorded references and measurements give the recorded voltages.
struct StampShift {
  LateStamp what;
  /// By how much later than the model's sensors stamp it [s]; negative: earlier.
  double late = 0.0;   ///< whole ticks
  double sigma = 0.0;  ///< standard error, of rounding to ticks, too [s]
  double tick = 0.0;   ///< of the controllers [s]
};

/// How recorded voltages follow from recorded references and measurements under position control:
///   V(t) = K_P (r(t - tick) - position(t - tick)) - K_D velocity(t - tick) + K_f force(t - tick)
/// where `tick` is the controllers' period: a row of the model's sensors has the voltage that has
/// acted until then. No physics enters, so what the model is missing elsewhere does not matter.
///
/// Wrong stamps show as other shifts: of the voltages, all three terms move; of positions or
/// forces, their terms alone. A controller that gets measurements or references late looks like
/// stamps that come too early, which no sensor does: `sensing_latency` and `command_latency` begin
/// there.
///
/// Each shift is judged by the squares that it leaves, less those that noise of the measurements
/// leaves (interpolated between rows, it is less), over blocks of time.
class ControllerAlgebra {
 public:
  /// @param recordings that were taken alike; kept as copies of what is needed
  ControllerAlgebra(const RobotModel& robot, const std::vector<const Dataset*>& recordings,
                    const ControllerAlgebraOptions& options);

  /// Whether the recordings have what the law needs.
  bool is_known() const { return noise_.size() >= options_.fewest_blocks && !muscles_.empty(); }
  /// The shift that is certain; nothing if there is none, or another cause does as well.
  std::optional<StampShift> stamp_shift() const;
  /// Whether the shift leaves less of this recording than none does: it may be of another make.
  bool helps(const StampShift& shift, std::size_t recording) const;
  /// What is left at this shift, in standard deviations of the voltages' own noise.
  double left(const std::optional<StampShift>& shift) const;

 private:
  struct Muscle {
    ecu::PositionGains gains;
    Series voltage, reference, position, velocity, force;
    double weight = 0.0;  ///< 1 / squared noise of the voltages [1/V^2]
    /// Squared, of the measurements [rad^2, (rad/s)^2, N^2].
    double position_noise = 0.0, velocity_noise = 0.0, force_noise = 0.0;
    std::vector<std::size_t> rows;                ///< of `voltage`, that are looked at
    std::size_t first_block = 0, last_block = 0;  ///< of its recording

    std::size_t block_of(std::size_t row, double length) const;
    /// Squares that this leaves in the voltages that these gains give [V^2].
    double noise(const ecu::PositionGains& of, double position_variance,
                 double force_variance) const;
  };
  /// How much earlier than the row each term is taken [s].
  struct Shifts {
    double reference, position, force;
  };
  using Squares = std::vector<double>;  ///< by block

  void add(const MuscleModel& muscle, const Dataset& recording, std::size_t most_rows);
  Shifts shifts(LateStamp what, double late) const;
  Squares squares(const Shifts& shifts) const;
  /// With the gains of least squares.
  Squares squares_of_free_gains() const;
  /// In standard errors over blocks, by how much the first leaves more than the second. Logarithms,
  /// because most of the squares may be in few blocks.
  double sureness(const Squares& first, const Squares& second) const;

  ControllerAlgebraOptions options_;
  double tick_ = 0.0;
  std::vector<std::size_t> first_blocks_;  ///< of each recording, and the number of all
  Squares noise_;                          ///< that noise of the measurements leaves
  std::vector<Muscle> muscles_;
};

}  // namespace discovery
}  // namespace anthrob
