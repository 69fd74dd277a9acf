#pragma once

#include "anthrob_core/files.h"
#include "identification/ring_identification.h"

namespace anthrob {
namespace identification {

/// stress_strain_<ring>.svg, as Figure 7.4: stress just after the stretch and at its end.
std::string stress_strain_figure(const RingResult& ring);
/// zener_<ring>.svg or wiechert_<ring>.svg, as Figures 7.5 to 7.7.
std::string model_figure(const RingResult& ring, const RingModelResult& model);
/// errors.svg, as Figure 7.8.
std::string error_figure(const std::vector<RingResult>& rings);

}  // namespace identification
}  // namespace anthrob
