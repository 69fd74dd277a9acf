#pragma once

#include <map>
#include <string>
#include <vector>

#include "anthrob_config/config_node.h"

namespace anthrob {

/// A number of a model file that measurements may correct.
struct ModelParameter {
  std::string path;      ///< key path in the model file: "muscles.brachialis.path.2.point.0"
  std::string unit;      ///< "m"
  double initial = 0.0;  ///< as the model file has it
  double lower = 0.0, upper = 0.0;
  double step = 0.0;  ///< size of an ordinary correction, > 0

  double range() const { return upper - lower; }
  /// "path" without the words that say nothing: "brachialis.path.2.x"
  std::string name() const;
};

/// What becomes of a range from `low` to `high` in which the model's own value is not.
enum class Outside { kRefuse, kWiden };

/// Reads the parameters of a calibration from a list of patterns,
///   - {path: "muscles.*.spindle_radius", unit: m, range: 0.0005, step: 0.0001}
///   - {path: "muscles.{biceps_brachii,brachialis}.path.-2.point.*", unit: m, range: 0.0025, step:
///   0.001}
///   - {path: "joints.*.friction.viscous", unit: Nms/rad, low: 0.0, high: 0.5, step: 0.05}
/// and finds their places in a model file. A word of a path is a key, a number that counts entries
/// of a list from 0, or from the end if negative, `*` for all, or `{a,b}` for some. `range` goes
/// both ways from the model file's value.
/// `if_present: true` lets a pattern match nothing.
/// @param list the sequence of patterns   @param model the model file they are about
/// @throws BadInput for patterns that match no number, numbers that match twice, empty ranges, and
/// initial values that are out of range
std::vector<ModelParameter> read_parameters(const ConfigNode& list, const ConfigNode& model,
                                            Outside outside = Outside::kRefuse);

/// What an ordinary calibration may correct of a model: `parameters` of the named file, or of
/// calibration.yaml beside the model or beside the one that it extends; nothing if there is none.
/// Ranges reach as far as the model's own values: it may have been calibrated by wider ones.
/// @param remarks gets a line on keys that only anthrob_calibrate knows what to do with
/// @throws BadInput, also for keys that nobody knows
std::vector<ModelParameter> ordinary_parameters(const std::string& model_file,
                                                std::string calibration_file = "",
                                                std::vector<std::string>* remarks = nullptr);

/// Overrides for LoadOptions.
std::map<std::string, double> overrides_of(const std::vector<ModelParameter>& parameters,
                                           const std::vector<double>& values);

}  // namespace anthrob
