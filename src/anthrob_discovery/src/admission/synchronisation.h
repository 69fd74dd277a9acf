#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "options/admission.h"

namespace anthrob {
namespace discovery {

/// Looks for joints that were stamped by another clock than their muscles.
///
/// Lengths of paths tie the velocities of joints to velocities of motors and rates of forces (which
/// stretch springs), whatever the dynamics are: friction, backlash and resonance do not delay them.
/// So the velocities are fitted by those rates, by linear regression at many lags. Each lag is
/// judged by the share of the squares that a fit to every second second explains in the others.
///
/// A file of joints is refused if a lag beyond half a second explains much of several movements and
/// clearly more than any shorter lag. It gets a remark if the lag is beyond 0.25 s (a `mocap_delay`
/// may be up to 0.2 s), or where there were fewer movements. Recordings without forces or motor
/// positions are not examined.
/// @return remarks   @throws BadInput with one line
std::vector<std::string> remarks_on_clocks(const RobotModel& robot, const Dataset& recording,
                                           const AdmissionOptions& options);

}  // namespace discovery
}  // namespace anthrob
