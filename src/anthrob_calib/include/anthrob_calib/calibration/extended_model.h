#pragma once

#include <map>
#include <string>

#include "anthrob_sim/model/config_node.h"

namespace anthrob {
namespace calibration {

/// A model file that extends another one by some numbers: `extends:` and what changes. Lists are
/// written whole, because a file that extends replaces them whole.
/// @param model what is extended, with its own `extends` merged
/// @param overrides numbers by key path
/// @param folder where the text will be put: file names in it are relative to that
/// @param comment first lines, without "# "
std::string extended_model_text(const ConfigNode& model, const std::string& model_file,
                                const std::map<std::string, double>& overrides,
                                const std::string& folder, const std::string& comment);

}  // namespace calibration
}  // namespace anthrob
