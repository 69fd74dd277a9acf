#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "anthrob_recording/series.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// The measured motion of a driven joint, continuous in position and velocity: at the edges of
/// bins, parabolas through the measured positions around them, or cubics where parabolas flatten
/// the motion by more than the noise of cubics; Hermite's cubics between the edges. The change of
/// velocity over a bin, and with it the inertial effort in its mean, is that of the edges.
class AxisMotion {
 public:
  /// @param position measured, two samples or more   @param bin [s]
  AxisMotion(const Series& position, double bin, std::size_t bins, const AxisOptions& options);

  std::size_t bins() const { return position_.size() - 1; }
  /// At a time that may lie before the first edge: the joint comes with constant velocity.
  double position(double time) const;
  double velocity_at_edge(std::size_t edge) const { return velocity_[edge]; }
  double position_at_edge(std::size_t edge) const { return position_[edge]; }
  /// [rad/s, m/s] of a bin
  double mean_velocity(std::size_t b) const { return (position_[b + 1] - position_[b]) / bin_; }
  double mean_acceleration(std::size_t b) const { return (velocity_[b + 1] - velocity_[b]) / bin_; }
  /// Speed that the sensor cannot tell from rest [rad/s, m/s].
  double rest_speed() const { return rest_speed_; }
  /// Whether the joint surely moves, all over a bin and in one direction.
  bool moves(std::size_t b) const;

 private:
  void take_edges(const Series& position, double half_width, std::size_t bins, int degree,
                  const AxisOptions& options);

  double bin_;
  std::vector<double> position_, velocity_;  ///< at the edges
  double rest_speed_ = 0.0;
};

/// Usual distance of two samples [s].
double usual_period(const Series& series);

/// Begin and end [s] of each hole in a series that a polynomial does not bridge.
/// @param end of the recording [s]   @param bin [s]
std::vector<std::pair<double, double>> holes_of(const Series& series, double end, double bin,
                                                const AxisOptions& options);

}  // namespace discovery
}  // namespace anthrob
