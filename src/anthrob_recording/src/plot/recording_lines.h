#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_recording/svg_figure.h"

namespace anthrob {

/// A series as a line of a figure, of at most a few thousand points: of each stretch of time the
/// least and the most. It is broken where a value is no number.
SvgFigure::Line series_line(const std::string& label, const Series& series, double scale = 1.0);

/// The turn of a ball joint from rest about x, y and z, and its angle [rad].
std::vector<Series> turns_of(const Dataset& data, const std::string& joint);

/// What a sensor answered with `nan` is not drawn; of an orientation, all four numbers.
void leave_out_orientations_without_answer(Dataset& data);

}  // namespace anthrob
