#pragma once

#include <array>
#include <string>
#include <vector>

#include "admission/admission.h"

namespace anthrob {
namespace discovery {

/// How one kind of channel was taken: late, held, averaged, counted, by another clock or unit.
struct MeasurementProperty {
  std::string channel_kind;    ///< "voltage"
  std::string place;           ///< "all", or where it differs
  std::string what;            ///< delay | tick_phase | hold | average | filter | count | clock ...
  double value = 0.0;          ///< [unit]
  std::array<double, 2> ci95;  ///< [unit]
  std::string unit;
  std::string source;  ///< meta | found | assumed
};

/// How the recordings were taken, as far as it is known.
using Measurement = std::vector<MeasurementProperty>;

/// Nothing is asked of the recordings yet: they are taken as the model's `sensors:` say.
Measurement describe(const Admission& admission);

}  // namespace discovery
}  // namespace anthrob
