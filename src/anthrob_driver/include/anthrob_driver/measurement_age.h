#pragma once

namespace anthrob {
namespace driver {

/// [s] between sending a SYNC and the wire; a cycle of the usual rate.
constexpr double kLongestWait = 0.005;
/// [s]; what is older says nothing of the robot as it is now.
constexpr double kOldestMeasurement = 0.5;

/// How old a measurement is [s]. The kernel knows best when its SYNC was on the wire, but tells it
/// by the wall clock, which may be set in between; the driver's clock cannot.
/// @param since_sent [s] of the driver's clock since the SYNC was sent
/// @param since_wire [s] of the wall clock since it was on the wire; NaN: not known
inline double measurement_age(double since_sent, double since_wire) {
  const double waited = since_sent - since_wire;
  return waited >= 0.0 && waited <= kLongestWait ? since_wire : since_sent;
}

}  // namespace driver
}  // namespace anthrob
