#pragma once

#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "identification/ring_identification.h"

namespace anthrob {
namespace identification {

/// springs.yaml (to paste into a model; none if no model fits any ring), report.json, and for every
/// ring the figures of the thesis: stress_strain_<ring>.svg (7.4), zener_<ring>.svg (7.5),
/// wiechert_<ring>.svg (7.6, 7.7); with several rings errors.svg (7.8).
OutputFiles report_rings(const std::vector<RingResult>& rings);

/// The result as a table of text for the terminal.
std::string summary_of_rings(const std::vector<RingResult>& rings);

}  // namespace identification
}  // namespace anthrob
