// Figures of a recording: joint angles, actuator positions, muscle forces.
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
#include "anthrob_recording/svg_figure.h"
#include "plot/recording_lines.h"

namespace anthrob {
namespace {

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

void add_ball_joint(const Dataset& data, const std::string& joint, SvgFigure& figure) {
  static const char* const kLabels[] = {"about x", "about y", "about z", "total angle"};
  auto& panel = figure.add_panel("time [s]", joint + " from rest [deg]");
  const std::vector<Series> turns = turns_of(data, joint);
  for (std::size_t k = 0; k < turns.size(); ++k)
    panel.lines.push_back(series_line(kLabels[k], turns[k], kDegrees));
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
    panel.lines.push_back(series_line(joint, data.series(joint + "/position")));
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
    panel.lines.push_back(series_line(muscle, data.series(muscle + "/" + quantity)));
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
        std::cout << "wrote " << out << "/" << name << "\n";
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
