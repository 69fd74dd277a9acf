#pragma once

#include <string>
#include <vector>

#include "anthrob_core/files.h"
#include "health/findings.h"

namespace anthrob {
namespace health {

/// The state of a robot's tendons after a test.
struct HealthReport {
  OutputFiles files;               ///< health.json and figures; write_health makes the page
  std::string headline;            ///< "11 tendons: nothing has changed"
  std::vector<std::string> lines;  ///< a line for each finding
};

/// @param latest of the last test, for what it did not tell
HealthReport report_health(const std::string& robot, const History& history,
                           const std::vector<TendonFigures>& latest, const HealthOptions& options);

/// Adds a test to the history in a folder, and writes history, report and page anew.
/// @throws BadInput, std::runtime_error with one line
HealthReport add_to_history(const std::string& folder, const std::string& robot, double day,
                            const std::vector<TendonFigures>& tendons,
                            const HealthOptions& options);

}  // namespace health
}  // namespace anthrob
