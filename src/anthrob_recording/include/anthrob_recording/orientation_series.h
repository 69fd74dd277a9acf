#pragma once

#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// The measured orientation of a ball joint over time.
struct OrientationSeries {
  Series number[4];  ///< w, x, y, z, at the same times, without sudden changes of sign

  /// Reads the orientation of a joint; empty if it was not measured.
  /// @throws BadInput if the four numbers were not measured at the same times, or if one of the
  /// quaternions is not of unit length
  /// @param only_first leaves out, and does not look at, all but the first orientation
  static OrientationSeries read(const Dataset& recording, const std::string& joint,
                                bool only_first = false);

  bool empty() const { return number[0].empty(); }
  const std::vector<double>& t() const { return number[0].t; }  ///< [s]
  /// Interpolated along the shortest rotation between two samples, constant beyond the ends.
  /// @param turn gets w, x, y, z, of unit length
  void at(double time, double* turn) const;
};

}  // namespace anthrob
