// Figures of a recording: joint angles, actuator positions, muscle forces.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <vector>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_core/pose.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_recording/svg_figure.h"

namespace anthrob {
namespace {

constexpr std::size_t kMostPoints = 2000;

/// All owners that have a quantity, in the order of their first column.
std::vector<std::string> owners(const Dataset& data, const std::string& quantity, bool muscles) {
  static const std::set<std::string> kOfMuscles = {"mode",    "reference", "current",
                                                   "voltage", "force",     "ecu_state"};
  std::set<std::string> of_muscles;
  for (const Table& table : data.tables) {
    for (const Column& column : table.columns) {
      if (kOfMuscles.count(column.quantity()) > 0) of_muscles.insert(column.owner());
    }
  }
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Table& table : data.tables) {
    for (const Column& column : table.columns) {
      if (column.quantity() != quantity || (of_muscles.count(column.owner()) > 0) != muscles)
        continue;
      if (seen.insert(column.owner()).second) names.push_back(column.owner());
    }
  }
  return names;
}

/// What a sensor answered with `nan` is not drawn; of an orientation, all four numbers.
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

SvgFigure::Line line(const std::string& label, const Series& series, double scale) {
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

void add_ball_joint(const Dataset& data, const std::string& joint, SvgFigure& figure) {
  const OrientationSeries turns = OrientationSeries::read(data, joint);
  Series axes[3], angle;
  for (std::size_t i = 0; i < turns.t().size(); ++i) {
    const auto number = [&](int k) { return turns.number[k].values[i]; };
    // A quaternion and its negative are the same rotation: take the one of at most 180 degrees.
    const double sign = number(0) < 0.0 ? -1.0 : 1.0;
    const Vec3 v = sign * Vec3(number(1), number(2), number(3));
    const double turned = 2.0 * std::atan2(v.norm(), sign * number(0));
    for (int k = 0; k < 3; ++k) {
      axes[k].t.push_back(turns.t()[i]);
      axes[k].values.push_back(v.norm() > 0.0 ? turned * v[k] / v.norm() : 0.0);
    }
    angle.t.push_back(turns.t()[i]);
    angle.values.push_back(turned);
  }
  auto& panel = figure.add_panel("time [s]", joint + " from rest [deg]");
  for (int k = 0; k < 3; ++k) {
    panel.lines.push_back(line(std::string("about ") + "xyz"[k], axes[k], kDegrees));
  }
  panel.lines.push_back(line("total angle", angle, kDegrees));
  panel.lines.back().dashed = true;
  panel.lines.back().colour = 9;
}

/// None without joints.
std::optional<std::string> joint_figure(const Dataset& data) {
  const auto balls = owners(data, "w", false), others = owners(data, "position", false);
  if (balls.empty() && others.empty()) return std::nullopt;
  SvgFigure figure("Joint angles");
  for (const std::string& joint : balls) add_ball_joint(data, joint, figure);
  for (const std::string& joint : others) {
    // A recording does not say whether a joint turns or slides.
    auto& panel = figure.add_panel("time [s]", joint + " [rad or m]");
    panel.lines.push_back(line(joint, data.series(joint + "/position"), 1.0));
  }
  return figure.render();
}

/// None if no muscle has the quantity.
std::optional<std::string> muscle_figure(const Dataset& data, const std::string& title,
                                         const std::string& quantity, const std::string& unit) {
  const auto muscles = owners(data, quantity, true);
  if (muscles.empty()) return std::nullopt;
  SvgFigure figure(title);
  auto& panel = figure.add_panel("time [s]", quantity + " [" + unit + "]");
  for (const std::string& muscle : muscles) {
    panel.lines.push_back(line(muscle, data.series(muscle + "/" + quantity), 1.0));
  }
  return figure.render();
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app("Draws a recording: joint_angles.svg, actuator_positions.svg, muscle_forces.svg.",
               "anthrob_plot");
  std::string in, out;
  app.add_option("IN", in, "bag or dataset folder")->required();
  app.add_option("--out", out, "folder for the figures")->required();
  return tool::run(app, argc, argv, [&]() -> int {
    Dataset data = load_recording(in);
    leave_out_orientations_without_answer(data);
    tool::say(app, data.remarks);
    std::error_code error;
    std::filesystem::create_directories(out, error);
    const auto write = [&](const std::string& name, const std::optional<std::string>& svg,
                           const char* shown) {
      if (svg) {
        write_file_atomically(out + "/" + name, *svg);
      } else {
        tool::say(app, {"no " + name + ": the recording has no " + shown});
      }
    };
    write("joint_angles.svg", joint_figure(data), "joints");
    write("actuator_positions.svg", muscle_figure(data, "Actuator positions", "position", "rad"),
          "positions of muscles");
    write("muscle_forces.svg", muscle_figure(data, "Muscle forces", "force", "N"),
          "forces of muscles");
    return tool::kDone;
  });
}
