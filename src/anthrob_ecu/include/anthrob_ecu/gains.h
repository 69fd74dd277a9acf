#pragma once

#include <string>
#include <vector>

#include "anthrob_ecu/parameters.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace ecu {

/// The gains of the control laws as a user names, reads and changes them, the same on simulator and
/// hardware: those parameters that may be written while enabled.
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

/// Of all muscles that have gains: a motor with a controller takes POSITION.
std::vector<Gain> gains_of(const std::vector<MuscleChannel>& muscles);

/// Checks a whole request; fills `changes` only if all of it is good.
/// @param names of muscles; an empty one: all that have gains
/// @return why it is refused; empty: it is not
std::string read_gain_changes(const std::vector<MuscleChannel>& muscles,
                              const std::vector<std::string>& names,
                              const std::vector<std::string>& gains,
                              const std::vector<double>& values, std::vector<GainChange>& changes);

}  // namespace ecu
}  // namespace anthrob
