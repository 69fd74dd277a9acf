#pragma once

#include <algorithm>
#include <string>

namespace anthrob {
namespace mocap {

/// Two cameras that are driven by this computer.
struct CameraOptions {
  std::string name[2];        ///< left, right: as the library calls them
  int width = 0, height = 0;  ///< [pixel] as calibrated
  double rate = 60.0;  ///< [Hz] of triggers, or of cameras that run freely (dc1394: their own)
  double exposure = 0.0005;  ///< [s]
  /// Empty: the first of its source's. aravis: software, free, or a line of the camera ("Line0");
  /// dc1394: external, free.
  std::string trigger;
  /// [s] between the arrivals of a pair; half a period at most. 0: as tolerance() says.
  double sync_tolerance = 0.0;

  /// [s] sync_tolerance, or 0.004 s where cameras are slow enough for it
  double tolerance() const {
    return sync_tolerance > 0.0 ? sync_tolerance : std::min(0.004, 0.5 / rate);
  }
  double silence() const { return std::max(0.5, 3.0 / rate); }   ///< [s] without images: trouble
  double patience() const { return std::max(1.0, 3.0 / rate); }  ///< [s] then: opened anew

  /// @param source for the message
  /// @throws BadInput if a number makes no sense
  void check(const std::string& source) const;
};

}  // namespace mocap
}  // namespace anthrob
