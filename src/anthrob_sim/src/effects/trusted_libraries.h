#pragma once

#include <string>

namespace anthrob {

/// Environment variable: libraries with effects that models may load, separated by colons.
constexpr const char* kTrustedLibraries = "ANTHROB_EFFECT_LIBRARIES";

/// A library runs whatever it likes, so a model of a stranger must not choose it alone.
/// @param name as the model has it   @param file where it is, or how the loader looks for it
/// @param trusted names, files and folders, separated by colons; a folder stands for all below it
bool is_trusted(const std::string& name, const std::string& file, const std::string& trusted);

}  // namespace anthrob
