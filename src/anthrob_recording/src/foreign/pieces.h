#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// A part of a recording that becomes a data set of its own.
struct Piece {
  std::string name;
  double from = 0.0, to = 0.0;  ///< [s] since the first row; rows in [from, to)
};

/// The rows of a piece, with their times. What holds until its next row (references, modes,
/// voltages, efforts, loads, pushes) and has no cell in the piece's first row has there what it had
/// before.
/// @throws BadInput if fewer than two rows are in the piece
Dataset cut(const Dataset& whole, const Piece& piece);

}  // namespace anthrob
