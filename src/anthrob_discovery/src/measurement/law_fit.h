#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "measurement/control_law.h"

namespace anthrob {
namespace discovery {

/// The law of this form and time constant [s], with its numbers.
ControlLaw fit_law(const ControlledMuscles& data, LawForm form, double time_constant,
                   bool after_tick);

}  // namespace discovery
}  // namespace anthrob
