#pragma once

#include <string>
#include <vector>

#include "experiment/noise_floor.h"

namespace anthrob {
namespace discovery {

/// A measured quantity on which a residual might depend, at the bins of experiments.
struct MeasuredVariable {
  std::string name;                         ///< column, "time"
  std::string word;                         ///< "load", "posture", "speed", "wrap angle", ...
  std::vector<std::vector<double>> values;  ///< by experiment and bin [unit of the column]
  bool sign = false;                        ///< only its sign counts
  std::string unit;                         ///< of the values; empty: not known

  std::string owner() const { return name.substr(0, name.find('/')); }
};

/// Time, and the quantities that may explain a residual: columns that all recordings have, and
/// speeds derived from positions.
std::vector<MeasuredVariable> measured_variables(const Experiments& experiments,
                                                 const std::vector<Dataset>& recordings,
                                                 const ExperimentOptions& options);

}  // namespace discovery
}  // namespace anthrob
