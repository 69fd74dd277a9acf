#pragma once

namespace anthrob {
namespace driver {

/// [s] Longest plausible time from sending a SYNC until it is on the wire: a cycle at 200 Hz.
constexpr double kLongestWait = 0.005;
/// [s]; older measurements are not published.
constexpr double kOldestMeasurement = 0.5;

/// Age of a measurement [s]. The kernel knows best when its SYNC was on the wire, but it uses the
/// wall clock, which may be set in between. If the two ages do not fit, the driver's clock counts.
/// @param since_sent [s] of the driver's clock since the SYNC was sent
/// @param since_wire [s] of the wall clock since it was on the wire; NaN: not known
inline double measurement_age(double since_sent, double since_wire) {
  const double waited = since_sent - since_wire;
  return waited >= 0.0 && waited <= kLongestWait ? since_wire : since_sent;
}

}  // namespace driver
}  // namespace anthrob
