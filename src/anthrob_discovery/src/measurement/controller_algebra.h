#pragma once

#include <optional>
#include <vector>

#include "measurement/controlled_muscles.h"

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
  bool is_known() const { return data_.is_known(); }
  /// The shift that is certain; nothing if there is none, or another cause does as well.
  std::optional<StampShift> stamp_shift() const;
  /// Whether the shift leaves less of this recording than none does: it may be of another make.
  bool helps(const StampShift& shift, std::size_t recording) const;
  /// What is left at this shift, in standard deviations of the voltages' own noise.
  double left(const std::optional<StampShift>& shift) const;
  Squares squares_at(const std::optional<StampShift>& shift) const;
  /// Measurements or references that reach the controllers late, the one that leaves least: as late
  /// as stamps can be, or as latencies (ControllerAlgebraOptions::longest_latency).
  std::optional<StampShift> latency() const;
  const ControlledMuscles& data() const { return data_; }

 private:
  /// How much earlier than the row each term is taken [s].
  struct Shifts {
    double reference, position, force;
  };

  Shifts shifts(LateStamp what, double late) const;
  Squares squares(const Shifts& shifts) const;
  /// With the gains of least squares.
  Squares squares_of_free_gains() const;
  /// The shift of one cause that leaves least; nothing if it is beyond these.
  /// @param earliest, latest [ticks]
  struct Cause;
  std::optional<Cause> best_shift(LateStamp what, long earliest, long latest) const;

  ControlledMuscles data_;
};

}  // namespace discovery
}  // namespace anthrob
