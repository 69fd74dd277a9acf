#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/admission.h"

namespace anthrob {
namespace discovery {

/// A table of joints that was stamped by another clock than the muscles.
struct ClockOffset {
  std::string table;
  double late = 0.0;                         ///< its stamps [s]; negative: early
  double explained = 0.0, as_stamped = 0.0;  ///< shares of the joints' motion, shifted and not
  bool certain = false;                      ///< else there were only few movements
};

/// Looks for joints that were stamped by another clock than their muscles.
///
/// Lengths of paths tie the velocities of joints to velocities of motors and rates of forces (which
/// stretch springs), whatever the dynamics are: friction, backlash and resonance do not delay them.
/// So the velocities are fitted by those rates, by linear regression at many lags. Each lag is
/// judged by the share of the squares that a fit to every second second explains in the others.
///
/// A table is found if a lag beyond 0.25 s (a `mocap_delay` may be up to 0.2 s) explains much and
/// leaves half as much as any shorter one. Recordings without forces or motor positions are not
/// examined.
std::vector<ClockOffset> clock_offsets(const RobotModel& robot, const Dataset& recording,
                                       const AdmissionOptions& options);

}  // namespace discovery
}  // namespace anthrob
