#pragma once

#include <vector>

#include "anthrob_sim/friction/friction_law.h"

namespace anthrob {

/// The part of a muscle beyond its spring: where it slides over eyelets and surfaces, tension falls
/// or rises with the sliding speed, which depends on how the joints move. Flat arrays, refilled
/// every step.
struct SlidingTendon {
  struct Contact {
    const FrictionLaw* law;
    StateView state;
    double turning = 0.0;  ///< alpha [rad]
  };

  double tension = 0.0;   ///< at the spring [N]
  std::vector<int> dofs;  ///< generalised velocities that move this part
  std::vector<Contact> contacts;
  /// Moment arms of the piece after contact j, up to the next one; row j, column as in `dofs` [m].
  std::vector<double> piece_arms;
  /// The same from contact j to the insertion: the sliding speed is its product with the
  /// velocities.
  std::vector<double> slide_arms;
  std::vector<double> tension_after;  ///< result: tension after contact j [N]
  std::vector<double> slide_speed;    ///< result: at the end of the step [m/s]
  std::vector<double> start_speed;    ///< at the start of the step [m/s]
  // Values that the solver's last sweep used.
  std::vector<double> mu, slope;  ///< of friction [1, s/m]
  std::vector<double> steepness;  ///< fall of the tension after contact j with sliding speed [Ns/m]
};

}  // namespace anthrob
