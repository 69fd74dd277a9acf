#pragma once

#include <optional>
#include <string>

#include "core/image.h"

namespace anthrob {
namespace mocap {

/// Reads an 8-bit grey image.
/// @throws BadInput naming the file if it is missing, truncated, 16-bit, in colour or no image
Image read_grey_image(const std::string& file);

/// The same, but colours become grey: for pictures of checkerboards.
Image read_any_image(const std::string& file);

void write_grey_image(const std::string& file, const Image& image);

/// The last number in the name of an image file, as written: "07" of "rig2_07_l.png". It says which
/// images belong together and in which order they were taken. None if there is no number, or if it
/// is the decimals of a stamp ("1700000000.25.png").
std::optional<std::string> image_number(const std::string& file);

/// Names of the image files of a folder, sorted as text.
/// @throws BadInput if there is no such folder or no image in it
std::vector<std::string> list_images(const std::string& folder);

}  // namespace mocap
}  // namespace anthrob
