#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "identification/capstan_fit.h"

namespace anthrob {
namespace identification {

/// The friction of an eyelet: fitted to the first specimen, validated on the others.
struct EyeletResult {
  std::vector<EyeletRecording> recordings;
  int specimen = 1;  ///< the one that was fitted
  std::vector<SlidingPoint> fitted, others;
  CapstanFit fit;
  double fit_error = 0.0;                  ///< [N]
  std::optional<double> validation_error;  ///< [N]
};

EyeletResult identify_eyelet(std::vector<EyeletRecording> recordings);

/// eyelet_friction.yaml (to paste into a model), report.json, eyelet.svg as Figure 7.9.
OutputFiles report_eyelet(const EyeletResult& result);

std::string summary_of_eyelet(const EyeletResult& result);

}  // namespace identification
}  // namespace anthrob
