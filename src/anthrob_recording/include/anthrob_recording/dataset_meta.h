#pragma once

#include <map>
#include <string>
#include <vector>

namespace anthrob {

class ConfigNode;

/// meta.yaml of a dataset folder. What is not listed here is kept in `other`.
struct DatasetMeta {
  std::string robot;
  std::string kind = "trajectory";               ///< equilibrium | trajectory | rig
  double rate = 0.0;                             ///< [Hz], 0: not given
  std::string start = "first";                   ///< first | zero | given
  std::map<std::string, double> start_position;  ///< [rad] by muscle, if `given`
  double settle_s = 5.0;                         ///< [s]
  /// Numbers of the model file that were others in this recording, by key path, as
  /// LoadOptions::overrides: a load, a mass, a length.
  std::map<std::string, double> model;
  std::map<std::string, std::string> other_start;  ///< unknown keys of `start`, as YAML text
  std::map<std::string, std::string> other;  ///< sensors, notes and unknown keys, as YAML text

  /// Takes `start` and `start_position` from `first`, `zero` or `{muscle: rad}`. @throws BadInput
  void load_start_reference(const ConfigNode& reference);
  /// Takes `model` from `{path: number}`. @throws BadInput
  void load_model(const ConfigNode& numbers);
};

/// meta.yaml of a dataset folder, or NAME.yaml beside NAME.bag.
/// @param remarks gets one line for each unknown key
/// @throws BadInput for values that are not allowed
DatasetMeta load_meta(const std::string& file, std::vector<std::string>* remarks);
std::string meta_text(const DatasetMeta& meta);

}  // namespace anthrob
