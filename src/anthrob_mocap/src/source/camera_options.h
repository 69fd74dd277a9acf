#pragma once

#include <algorithm>
#include <string>

namespace anthrob {
namespace mocap {

/// Options of two cameras that this computer controls.
struct CameraOptions {
  std::string name[2];        ///< left, right: as the library calls them
  int width = 0, height = 0;  ///< [pixel] as calibrated
  /// [Hz] of triggers, or of free cameras: aravis sets it; with dc1394 it must state their own.
  double rate = 60.0;
  double exposure = 0.0005;  ///< [s]
  /// aravis: software (default), free, or a line of the camera ("Line0"); dc1394: external
  /// (default) or free. Empty: the default of the source.
  std::string trigger;
  /// [s] largest difference between the arrivals of a pair, at most half a period. 0: the default
  /// of tolerance().
  double sync_tolerance = 0.0;

  /// [s] sync_tolerance; if that is 0: 0.004 s, or half a period if that is shorter
  double tolerance() const {
    return sync_tolerance > 0.0 ? sync_tolerance : std::min(0.004, 0.5 / rate);
  }
  /// [s] without images until trouble is reported.
  double silence() const { return std::max(0.5, 3.0 / rate); }
  /// [s] without images until the camera is reopened.
  double patience() const { return std::max(1.0, 3.0 / rate); }

  /// @param source for the message
  /// @throws BadInput if a number is out of range
  void check(const std::string& source) const;
};

}  // namespace mocap
}  // namespace anthrob
