#include "plot/recording_lines.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/pose.h"
#include "anthrob_recording/orientation_series.h"

namespace anthrob {

namespace {

constexpr std::size_t kMostPoints = 2000;

}  // namespace

SvgFigure::Line series_line(const std::string& label, const Series& series, double scale) {
  SvgFigure::Line result;
  result.label = label;
  const auto draw = [&](std::size_t i) {
    result.x.push_back(series.t[i]);
    result.y.push_back(scale * series.values[i]);
  };
  const std::size_t count = series.t.size(), stride = 1 + 2 * count / kMostPoints;
  std::size_t begin = 0;
  while (begin < count) {
    // The least and the most of each block: a peak of one sample is what one looks for. A block
    // ends where nothing was measured.
    std::size_t end = begin, least = begin, most = begin;
    for (; end < std::min(begin + stride, count) && !std::isnan(series.values[end]); ++end) {
      if (series.values[end] < series.values[least]) least = end;
      if (series.values[end] > series.values[most]) most = end;
    }
    draw(std::min(least, most));
    if (least != most) draw(std::max(least, most));
    begin = std::max(end, begin + 1);  // after a gap's own sample
  }
  return result;
}

std::vector<Series> turns_of(const Dataset& data, const std::string& joint) {
  const OrientationSeries turns = OrientationSeries::read(data, joint);
  std::vector<Series> parts(4);
  for (Series& part : parts) part.t = turns.t();
  for (std::size_t i = 0; i < turns.t().size(); ++i) {
    const auto number = [&](int k) { return turns.number[k].values[i]; };
    // A quaternion and its negative are the same rotation: take the one of at most 180 degrees.
    const double sign = number(0) < 0.0 ? -1.0 : 1.0;
    const Vec3 v = sign * Vec3(number(1), number(2), number(3));
    const double turned = 2.0 * std::atan2(v.norm(), sign * number(0));
    for (int k = 0; k < 3; ++k)
      parts[k].values.push_back(v.norm() > 0.0 ? turned * v[k] / v.norm() : 0.0);
    parts[3].values.push_back(turned);
  }
  return parts;
}

void leave_out_orientations_without_answer(Dataset& data) {
  for (Table& table : data.tables) {
    for (const Column& first : table.columns) {
      if (first.quantity() != "w") continue;
      std::vector<Column*> parts;
      for (Column& column : table.columns) {
        const std::string quantity = column.quantity();
        const bool part = quantity == "w" || quantity == "x" || quantity == "y" || quantity == "z";
        if (part && column.owner() == first.owner()) parts.push_back(&column);
      }
      for (std::size_t i = 0; i < table.t.size(); ++i) {
        const bool answered = std::all_of(parts.begin(), parts.end(), [i](const Column* part) {
          return !part->present[i] || std::isfinite(part->values[i]);
        });
        if (answered) continue;
        for (Column* part : parts) part->present[i] = 0;
      }
    }
  }
}

}  // namespace anthrob
