#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_ecu/parameters.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace ecu {

/// A gain of a control law that a user may read and change, by the same names on simulator and
/// hardware. Gains are the parameters that may be written while enabled.
struct Gain {
  int muscle;
  Parameter parameter;
};
struct GainChange {
  Gain gain;
  double value;
};

const char* name(Parameter parameter);
/// @return null if there is no such gain
const ParameterInfo* find_gain(const std::string& name);

/// The gains of all muscles that have gains, which are those that accept POSITION commands.
std::vector<Gain> gains_of(const std::vector<MuscleChannel>& muscles);

/// Checks a whole request; fills `changes` only if all of it is good.
/// @param names muscle names; an empty name stands for all muscles that have gains
/// @return why the request is refused, if it is
std::optional<std::string> read_gain_changes(const std::vector<MuscleChannel>& muscles,
                                             const std::vector<std::string>& names,
                                             const std::vector<std::string>& gains,
                                             const std::vector<double>& values,
                                             std::vector<GainChange>& changes);

}  // namespace ecu
}  // namespace anthrob
