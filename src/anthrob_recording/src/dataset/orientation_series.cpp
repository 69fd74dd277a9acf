#include "anthrob_recording/orientation_series.h"

#include <cmath>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

/// By how much the square of an orientation's four numbers may differ from 1, by their noise.
constexpr double kUnit = 0.01;

}  // namespace

OrientationSeries OrientationSeries::read(const Dataset& recording, const std::string& joint,
                                          bool only_first) {
  const char* const names[] = {"/w", "/x", "/y", "/z"};
  OrientationSeries turns;
  for (int k = 0; k < 4; ++k) turns.number[k] = recording.series(joint + names[k]);
  for (Series& number : turns.number) {
    if (only_first && !number.empty()) number.t.resize(1), number.values.resize(1);
  }
  for (const Series& number : turns.number) {
    if (number.t == turns.t()) continue;
    throw BadInput(recording.folder + ": " + joint +
                   ": expected w, x, y and z of an orientation at the same times");
  }
  for (std::size_t i = 0; i < turns.t().size(); ++i) {
    double square = 0.0;
    for (const Series& number : turns.number) square += number.values[i] * number.values[i];
    if (std::abs(square - 1.0) <= kUnit) continue;
    throw BadInput(recording.folder + ": " + joint +
                   ": no unit quaternion at t = " + std::to_string(turns.t()[i]) +
                   " s: expected empty cells where the orientation was not measured");
  }
  // A quaternion and its negative are the same rotation, but not the way between two of them.
  for (std::size_t i = 1; i < turns.t().size(); ++i) {
    double cosine = 0.0;
    for (const Series& number : turns.number) cosine += number.values[i - 1] * number.values[i];
    if (cosine >= 0.0) continue;
    for (Series& number : turns.number) number.values[i] = -number.values[i];
  }
  return turns;
}

void OrientationSeries::at(double time, double* turn) const {
  double square = 0.0;
  for (int k = 0; k < 4; ++k) {
    turn[k] = number[k].at(time);
    square += turn[k] * turn[k];
  }
  for (int k = 0; k < 4; ++k) turn[k] /= std::sqrt(square);
}

}  // namespace anthrob
