// Muscles of a robot in one posture: lengths, forces, wrapping, moment arms.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>

#include "anthrob_core/files.h"
#include "anthrob_core/robots.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_sim/placement.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/tool.h"
#include "report/muscle_sweep.h"

namespace anthrob {
namespace {

/// One cell of the report: words or a number, or nothing.
struct Cell {
  std::string key;
  std::string text;
  double number = 0.0;
  enum Kind { kText, kNumber, kEmpty } kind = kNumber;
};
using Row = std::vector<Cell>;

Cell number(const std::string& key, double value) {
  return {key, "", value, Cell::kNumber};
}
Cell text(const std::string& key, const std::string& value) {
  return {key, value, 0.0, Cell::kText};
}
Cell empty(const std::string& key) {
  return {key, "", 0.0, Cell::kEmpty};
}

/// Names of the generalised velocities: "elbow", "shoulder_x".
std::vector<std::string> axis_names(const SkeletonModel& skeleton) {
  std::vector<std::string> names;
  for (const SweepAxis& axis : sweep_axes(skeleton)) names.push_back(axis.name);
  return names;
}

std::size_t surface_count(const Muscle& muscle) {
  std::size_t count = 0;
  for (const PathObstacle& obstacle : muscle.model().path->obstacles())
    count += obstacle.surface != nullptr;
  return count;
}

void add_surfaces(const Muscle& muscle, std::size_t columns, Row& row) {
  const auto& obstacles = muscle.model().path->obstacles();
  std::size_t n = 0;
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    if (!obstacles[i].surface) continue;
    const std::string key = "wrap" + std::to_string(++n) + "_";
    const ObstacleState& state = muscle.path().obstacles()[i];
    row.push_back(text(key + "type", obstacles[i].surface->type()));
    row.push_back(text(key + "state", state.touching ? "wrapping" : "not_wrapping"));
    row.push_back(number(key + "angle", state.touching ? state.wrap_angle : 0.0));
    const Vec3& entry = muscle.path().segments()[i - 1].to_W;
    const Vec3& exit = muscle.path().segments()[i].from_W;
    for (int k = 0; k < 3; ++k) {
      row.push_back(state.touching ? number(key + "entry_" + "xyz"[k], entry[k])
                                   : empty(key + "entry_" + "xyz"[k]));
    }
    for (int k = 0; k < 3; ++k) {
      row.push_back(state.touching ? number(key + "exit_" + "xyz"[k], exit[k])
                                   : empty(key + "exit_" + "xyz"[k]));
    }
    row.push_back(number(key + "penetration", state.penetration));
  }
  for (++n; n <= columns; ++n) {
    const std::string key = "wrap" + std::to_string(n) + "_";
    for (const char* name : {"type", "state", "angle", "entry_x", "entry_y", "entry_z", "exit_x",
                             "exit_y", "exit_z", "penetration"}) {
      row.push_back(empty(key + name));
    }
  }
}

std::vector<Row> report(const Simulation& sim) {
  const std::vector<std::string> axes = axis_names(*sim.model().skeleton);
  std::size_t surfaces = 0;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    surfaces = std::max(surfaces, surface_count(sim.muscle(m)));
  }
  std::vector<Row> rows;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const Muscle& muscle = sim.muscle(m);
    Row row{text("muscle", muscle.model().name), number("length", muscle.length()),
            number("see_expansion", muscle.expansion()), number("force", muscle.spring_tension())};
    const std::vector<double> arms = sim.moment_arms(static_cast<int>(m));
    for (std::size_t k = 0; k < arms.size(); ++k) row.push_back(number("arm_" + axes[k], arms[k]));
    add_surfaces(muscle, surfaces, row);
    rows.push_back(row);
  }
  return rows;
}

void print_csv(const std::vector<Row>& rows) {
  if (rows.empty()) return;
  for (std::size_t i = 0; i < rows[0].size(); ++i) std::cout << (i ? "," : "") << rows[0][i].key;
  std::cout << "\n";
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      std::cout << (i ? "," : "");
      if (row[i].kind == Cell::kText) std::cout << row[i].text;
      if (row[i].kind == Cell::kNumber) std::cout << exact_text(row[i].number);
    }
    std::cout << "\n";
  }
}

void print_json(const std::vector<Row>& rows) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Row& row : rows) {
    nlohmann::ordered_json object;
    for (const Cell& cell : row) {
      if (cell.kind == Cell::kText) {
        object[cell.key] = cell.text;
      } else if (cell.kind == Cell::kNumber) {
        object[cell.key] = cell.number;
      } else {
        object[cell.key] = nullptr;
      }
    }
    list.push_back(object);
  }
  std::cout << list.dump(2) << "\n";
}

/// For people: millimetres. The arm of a slide is a number without unit.
void print_table(const Simulation& sim) {
  const std::vector<std::string> axes = axis_names(*sim.model().skeleton);
  std::vector<double> scale(axes.size(), 1e3);
  bool slides = false;
  for (const JointModel& joint : sim.model().skeleton->joints) {
    if (joint.type != JointType::kPrismatic) continue;
    scale[static_cast<std::size_t>(joint.velocity_offset)] = 1.0;
    slides = true;
  }
  std::cout << std::left << std::setw(20) << "muscle" << std::right << std::setw(11) << "length mm"
            << std::setw(10) << "SEE mm" << std::setw(9) << "force N";
  for (const std::string& axis : axes) std::cout << std::setw(12) << axis;
  std::cout << "  wrapping (moment arms in mm" << (slides ? "; of slides in m/m" : "") << ")\n"
            << std::fixed;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const Muscle& muscle = sim.muscle(m);
    std::cout << std::left << std::setw(20) << muscle.model().name << std::right
              << std::setprecision(2) << std::setw(11) << 1e3 * muscle.length()
              << std::setprecision(3) << std::setw(10) << 1e3 * muscle.expansion()
              << std::setprecision(2) << std::setw(9) << muscle.spring_tension();
    std::size_t axis = 0;
    for (const double arm : sim.moment_arms(static_cast<int>(m))) {
      std::cout << std::setprecision(1) << std::setw(12) << scale[axis++] * arm;
    }
    const auto& obstacles = muscle.model().path->obstacles();
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const ObstacleState& state = muscle.path().obstacles()[i];
      const bool inside = state.penetration > kRoundingDepth;
      if (!obstacles[i].surface || !(state.touching || inside)) continue;
      std::cout << "  " << obstacles[i].surface->type() << std::setprecision(1);
      if (state.touching) std::cout << " " << state.wrap_angle * 180.0 / M_PI << " deg";
      if (inside) std::cout << " (a path point " << 1e3 * state.penetration << " mm inside)";
    }
    std::cout << "\n";
  }
}

/// @param option "--joint"   @param assignments its values   @return the names
std::vector<std::string> names_of(const std::string& option,
                                  const std::vector<std::string>& assignments) {
  std::vector<std::string> names;
  for (const std::string& text : assignments) {
    names.push_back(tool::parse_assignment(option, text).name);
  }
  refuse_repeated(option, names);
  return names;
}

void set_joint(const RobotModel& model, const std::string& option, Placement& placement) {
  const tool::Assignment a = tool::parse_assignment("--joint", option);
  const int index = model.skeleton->find_joint(a.name);
  if (index < 0)
    throw BadInput("--joint " + option + ": " + model.file + " has no movable joint '" + a.name +
                   "'");
  const JointModel& joint = model.skeleton->joints[index];
  const bool ball = joint.type == JointType::kBall;
  if (a.values.size() != static_cast<std::size_t>(joint.position_size())) {
    throw BadInput("--joint " + option + ": expected " +
                   (ball ? "a quaternion w,x,y,z" : "one number"));
  }
  if (!ball) return placement.set_joint(a.name, a.values[0]);
  placement.set_ball_joint(a.name, Quat(a.values[0], a.values[1], a.values[2], a.values[3]));
}

void set_position(const std::string& option, Placement& placement) {
  const tool::Assignment a = tool::parse_assignment("--position", option);
  if (a.values.size() != 1) throw BadInput("--position " + option + ": expected one number [rad]");
  placement.set_muscle(a.name, a.values[0]);
}

/// elbow=0:2:50 or shoulder_x=-1:1:50
MuscleSweep run_sweep(const std::shared_ptr<const RobotModel>& model, const std::string& option,
                      const std::vector<double>& q, const std::vector<double>& actuators) {
  const tool::Range range = tool::parse_range("--sweep", option);
  std::string known;
  for (const SweepAxis& axis : sweep_axes(*model->skeleton)) {
    if (axis.name == range.name) {
      return sweep_muscles(model, q, actuators, axis, range.from, range.to, range.points);
    }
    known += (known.empty() ? "" : ", ") + axis.name;
  }
  throw BadInput("--sweep " + option + ": no axis '" + range.name + "'; " + model->file +
                 " has: " + known);
}

bool wanted(const std::string& muscle, const std::vector<std::string>& only) {
  return only.empty() || std::find(only.begin(), only.end(), muscle) != only.end();
}

std::vector<Row> report(const MuscleSweep& sweep, const std::vector<std::string>& only) {
  std::vector<Row> rows;
  for (const MuscleCurve& curve : sweep.muscles) {
    if (!wanted(curve.muscle, only)) continue;
    for (std::size_t i = 0; i < sweep.position.size(); ++i) {
      rows.push_back({text("muscle", curve.muscle), number("length", curve.length[i]),
                      number("see_expansion", curve.expansion[i]), number("force", curve.force[i]),
                      number(sweep.axis.name, sweep.position[i]),
                      number("arm_" + sweep.axis.name, curve.moment_arm[i])});
    }
  }
  return rows;
}

void check_muscles(const RobotModel& model, const std::vector<std::string>& only) {
  for (const std::string& name : only) model.muscle_index(name);
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Prints lengths, spring expansions, forces, wrapping and moment arms (-dl/dq) of all "
      "muscles, in one posture or along a sweep of one joint axis. Springs are relaxed and there "
      "is no friction.",
      "anthrob_muscles");
  std::string robot = "anthrob", model_name = "II";
  std::string sweep, plot;
  std::vector<std::string> joints, positions, only;
  bool csv = false, json = false;
  app.add_option("--robot", robot, "name of a robot folder under config/, or the path of one")
      ->capture_default_str();
  app.add_option("--model", model_name,
                 "II for model_II.yaml in the robot's folder; anthrob/II or the path of a .yaml "
                 "file: --robot is not used")
      ->capture_default_str();
  app.add_option(
      "--joint", joints,
      "joint position, shoulder=w,x,y,z or elbow=1.57 [rad, m]; other joints are at rest");
  app.add_option("--position", positions, "motor position MUSCLE=rad; other motors are at 0");
  app.add_option("--sweep", sweep,
                 "move one axis, AXIS=FROM:TO:POINTS with 2 to 100000 points, e.g. elbow=0:2:50 or "
                 "shoulder_x=-1:1:50");
  app.add_option("--muscle", only, "show only this muscle of a sweep; may be repeated")
      ->needs("--sweep");
  app.add_option("--plot", plot, "draw a sweep to FILE.svg")
      ->needs("--sweep")
      ->check([](const std::string& file) -> std::string {
        return std::filesystem::path(file).extension() == ".svg" ? ""
                                                                 : file + ": expected FILE.svg";
      });
  app.add_flag("--csv", csv, "print comma-separated values in SI units");
  app.add_flag("--json", json, "print JSON in SI units")->excludes("--csv");
  return tool::run(app, argc, argv, [&]() -> int {
    const auto model = tool::load_model(app, find_model_file(robot, model_name));
    Placement placement(*model);
    const std::vector<std::string> named = names_of("--joint", joints);
    names_of("--position", positions);
    if (!sweep.empty()) {
      const std::string moved = tool::parse_range("--sweep", sweep).name;
      if (std::count(named.begin(), named.end(), moved) > 0) {
        throw BadInput("--joint " + moved + ": --sweep moves it; expected one of the two");
      }
    }
    for (const std::string& option : joints) set_joint(*model, option, placement);
    for (const std::string& option : positions) set_position(option, placement);
    check_muscles(*model, only);
    if (!sweep.empty()) {
      const MuscleSweep result = run_sweep(model, sweep, placement.q(), placement.positions());
      if (!plot.empty()) write_file_atomically(plot, draw_sweep(result, only).render());
      if (json) {
        print_json(report(result, only));
      } else if (csv || plot.empty()) {
        print_csv(report(result, only));
      }
      return tool::kDone;
    }
    Simulation sim(model);
    sim.place(placement.q(), placement.positions());
    if (json) {
      print_json(report(sim));
    } else if (csv) {
      print_csv(report(sim));
    } else {
      print_table(sim);
    }
    return tool::kDone;
  });
}
