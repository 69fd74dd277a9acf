#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"

namespace anthrob {

/// A number of a model file that a calibration may correct.
struct ModelParameter {
  std::string path;      ///< key path in the model file: "muscles.brachialis.path.2.point.0"
  std::string unit;      ///< "m"
  double initial = 0.0;  ///< value in the model file
  double lower = 0.0, upper = 0.0;
  double step = 0.0;  ///< typical size of a correction, > 0

  double range() const { return upper - lower; }
  /// A short form of "path": "brachialis.path.2.x"
  std::string name() const;
};

/// What to do if the model's own value is outside the range from `low` to `high`.
enum class Outside { kRefuse, kWiden };

/// Reads the parameters of a calibration from a list of patterns,
///   - {path: "muscles.*.spindle_radius", unit: m, range: 0.0005, step: 0.0001}
///   - {path: "muscles.{biceps_brachii,brachialis}.path.-2.point.*", unit: m, range: 0.0025, step:
///   0.001}
///   - {path: "joints.*.friction.viscous", unit: Nms/rad, low: 0.0, high: 0.5, step: 0.05}
/// and finds the numbers in a model file. A word of a path is a key, an index into a list (from 0,
/// or from the end if negative), `*` for all, or `{a,b}` for some. `range` extends in both
/// directions from the value in the model file. With `if_present: true` a pattern may match
/// nothing.
/// @param list the sequence of patterns   @param model the model file
/// @throws BadInput for patterns that match no number, numbers that match twice, empty ranges, and
/// initial values out of range
std::vector<ModelParameter> read_parameters(const ConfigNode& list, const ConfigNode& model,
                                            Outside outside = Outside::kRefuse);

/// The file that lists the ordinary parameters of a model: the given one, or calibration.yaml
/// beside the model or beside the model that it extends; none if neither exists.
std::optional<std::string> calibration_file_of(const std::string& model_file,
                                               const std::string& given = "");

/// The ordinary parameters of a model, which a calibration may correct: the list `parameters` of
/// its calibration_file_of(); empty if there is none. Ranges are widened to include the model's own
/// values, because the model may have been calibrated with wider ranges.
/// @param remarks gets a line about keys that only anthrob_calibrate uses
/// @throws BadInput, also for unknown keys
std::vector<ModelParameter> ordinary_parameters(const std::string& model_file,
                                                const std::string& calibration_file = "",
                                                std::vector<std::string>* remarks = nullptr);

/// Values by path, for LoadOptions::overrides.
std::map<std::string, double> overrides_of(const std::vector<ModelParameter>& parameters,
                                           const std::vector<double>& values);

}  // namespace anthrob
