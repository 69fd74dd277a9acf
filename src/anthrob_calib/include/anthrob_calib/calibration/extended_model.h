#pragma once

#include <map>
#include <string>

#include "anthrob_core/config_node.h"

namespace anthrob {
namespace calibration {

/// Text of a model file that extends another one: `extends:` and the numbers that change. If a
/// number is in a list, the whole list is written, because an extending file replaces lists as a
/// whole.
/// @param model the model that is extended, with its own `extends` merged
/// @param overrides numbers by key path
/// @param folder of the new file; file names in the text are relative to it
/// @param comment first lines, without "# "
std::string extended_model_text(const ConfigNode& model, const std::string& model_file,
                                const std::map<std::string, double>& overrides,
                                const std::string& folder, const std::string& comment);

}  // namespace calibration
}  // namespace anthrob
