#pragma once

#include <vector>

#include "anthrob_recording/dataset.h"
#include "fit/candidate.h"
#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// Doses of candidates at driven joints, in the units of what was measured there: a share of the
/// effort, of effort over speed, or of effort over range of motion. The catalogue's are those of a
/// human arm; on a small screw, ten of its smallest doses would be above all efforts.
/// @param recordings of `--train`
void scale_doses(const RobotModel& model, const std::vector<Dataset>& recordings,
                 const AxisDoseOptions& options, std::vector<Candidate>& candidates);

}  // namespace discovery
}  // namespace anthrob
