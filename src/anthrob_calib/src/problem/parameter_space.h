#pragma once

#include <map>
#include <string>
#include <vector>

#include "anthrob_core/parameter_list.h"

namespace anthrob {
namespace calibration {

/// The object parameters of a calibration: numbers of the model file, and numbers given as a share
/// of another one (Table D.11 has kinetic friction in percent of static friction).
class ParameterSpace {
 public:
  /// Reads `parameters` (see read_parameters()) and, if present, `shares`:
  ///   - {path: joints.shoulder.friction.kinetic, of: joints.shoulder.friction.static, low: 0.0,
  ///      high: 1.0, step: 0.1}
  /// @throws BadInput, also if a number is a share of a share
  ParameterSpace(const ConfigNode& config, const ConfigNode& model);

  const std::vector<ModelParameter>& parameters() const { return parameters_; }
  std::size_t size() const { return parameters_.size(); }
  std::vector<double> initial() const;
  /// Numbers to put into the model file, by key path.
  std::map<std::string, double> overrides(const std::vector<double>& values) const;

 private:
  void read_share(const ConfigNode& entry, const ConfigNode& model);

  struct Share {
    std::size_t parameter;  ///< index
    std::string of;
    double base;  ///< value of `of` in the model file
  };
  std::vector<ModelParameter> parameters_;
  std::vector<Share> shares_;
};

/// The number at a key path of a model file. @throws BadInput if there is none
double number_at(const ConfigNode& model, const std::string& path);

}  // namespace calibration
}  // namespace anthrob
