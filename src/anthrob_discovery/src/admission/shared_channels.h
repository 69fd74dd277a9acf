#pragma once

#include <string>
#include <vector>

#include "experiment/experiment.h"
#include "options/admission.h"

namespace anthrob {
namespace discovery {

/// Checks that held-out recordings can judge what training recordings teach.
/// @return a remark for each channel that only one side has
/// @throws BadInput if the two have no channel in common
std::vector<std::string> remarks_on_channels(const Experiments& train, const Experiments& test,
                                             const AdmissionOptions& options);

}  // namespace discovery
}  // namespace anthrob
