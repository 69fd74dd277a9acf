#pragma once

#include <optional>
#include <string>

#include "anthrob_core/pose.h"

namespace anthrob {

/// Mass and inertia of one link, held against what a body can have and what one of a robot has.
class PlausibleBody {
 public:
  /// @param mass [kg]
  /// @param inertia about the centre of mass [kg m^2]; in whatever axes
  /// @param extent largest distance from the link's origin that the link is known to have [m]; 0 if
  ///        nothing is known
  PlausibleBody(double mass, const Mat3& inertia, double extent);

  /// Why no body of a robot can have these numbers: "mass: ...", "inertia: ..."; none if one can.
  std::optional<std::string> impossible() const;
  /// Why they are odd, though possible; none if they are not.
  std::optional<std::string> odd() const;

  /// About the axis of the largest moment [m]; 0 without mass.
  double radius_of_gyration() const;

 private:
  bool is_denser_than_matter() const;
  std::string inertia_text() const;
  std::string likely_unit() const;

  double mass_;
  double extent_;
  Vec3 principal_;  ///< in ascending order [kg m^2]
};

}  // namespace anthrob
