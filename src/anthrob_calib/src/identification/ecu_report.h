#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "identification/series_resistance_fit.h"

namespace anthrob {
namespace identification {

/// The power stage of an ECU: fitted to the first specimen, validated on the others.
struct EcuResult {
  std::vector<LoadRecording> fitted, others;
  SeriesResistanceFit fit;
  double fit_error = 0.0;                  ///< [V]
  std::optional<double> validation_error;  ///< [V]
};

EcuResult identify_ecu(std::vector<LoadRecording> recordings);

/// power_stage.yaml (to paste into an actuator of a model), report.json, ecu.svg as Figure 7.11b.
OutputFiles report_ecu(const EcuResult& result);

std::string summary_of_ecu(const EcuResult& result);

}  // namespace identification
}  // namespace anthrob
