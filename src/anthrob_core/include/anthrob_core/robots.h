#pragma once

#include <string>

namespace anthrob {

/// The model file that a user names. Robots are folders: those under $ANTHROB_CONFIG, else under
/// config/ of the package anthrob_bringup, are known by their names; with a '/' it is the folder's
/// path.
/// @param robot name of a robot, for models that do not name theirs
/// @param model "II" for model_II.yaml in the robot's folder, "anthrob/II" for that of another
/// robot, or the path of a file (one that exists, or that ends in .yaml)
/// @throws BadInput naming what was looked for and where
std::string find_model_file(const std::string& robot, const std::string& model);

/// The same where nothing else names a robot: "II" is the model of Anthrob. What ends in .yaml is
/// left as it is, for its reader to find.
std::string find_model_file(const std::string& model);

}  // namespace anthrob
