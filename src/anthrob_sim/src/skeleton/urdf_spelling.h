#pragma once

#include "skeleton/urdf_file.h"

namespace anthrob {

/// Refuses what urdfdom would leave out without a word: unknown, misspelt and doubled elements and
/// attributes, text where attributes belong, and xacro that was not expanded. Blocks of other
/// programs directly in <robot>, as <gazebo> and <transmission>, are left alone.
/// @throws BadInput with file, line, what it belongs to, and what was expected
void refuse_what_is_not_read(const UrdfFile& file);

}  // namespace anthrob
