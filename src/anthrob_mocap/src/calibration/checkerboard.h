#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/types.h"

namespace anthrob {
namespace mocap {

/// A checkerboard by its inner corners.
struct Board {
  int columns = 9;
  int rows = 6;
  double square = 0.025;  ///< [m]

  /// "9x6".
  /// @throws BadInput
  static Board parse(const std::string& size, double square);
  std::vector<Vec3> points() const;  ///< row by row
};

/// Corners of the board to a fraction of a pixel, row by row from one of its corners; nothing if it
/// is not there as a whole.
std::optional<std::vector<Vec2>> find_corners(const Image& image, const Board& board);

/// The detector may begin at opposite corners in two pictures of one board: turns `right` round if
/// it runs against `left`.
void same_direction(const std::vector<Vec2>& left, std::vector<Vec2>& right);

}  // namespace mocap
}  // namespace anthrob
