#include "experiment/simulated_recording.h"

#include <cmath>
#include <functional>

#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace discovery {

namespace {

/// Columns of one table and where their values come from.
struct Sheet {
  Table table;
  std::vector<std::function<double(const Simulation&)>> sources;

  void add(const std::string& column, std::function<double(const Simulation&)> source) {
    table.column(column);
    sources.push_back(std::move(source));
  }
  void write_row(const Simulation& sim, double time) {
    table.t.push_back(static_cast<Nanoseconds>(std::llround(1e9 * time)));
    for (std::size_t i = 0; i < sources.size(); ++i) {
      table.columns[i].values.push_back(sources[i](sim));
      table.columns[i].present.push_back(1);
    }
  }
};

Sheet muscle_sheet(const RobotModel& robot) {
  Sheet sheet;
  sheet.table.name = "muscles";
  for (std::size_t m = 0; m < robot.muscles.size(); ++m) {
    const std::string& name = robot.muscles[m].name;
    sheet.add(name + "/position",
              [m](const Simulation& sim) { return sim.muscle(m).measured().position; });
    sheet.add(name + "/current",
              [m](const Simulation& sim) { return sim.muscle(m).measured().current; });
    sheet.add(name + "/voltage", [m](const Simulation& sim) { return sim.muscle(m).voltage(); });
    sheet.add(name + "/force",
              [m](const Simulation& sim) { return sim.muscle(m).measured().force; });
  }
  return sheet;
}

Sheet joint_sheet(const RobotModel& robot) {
  Sheet sheet;
  sheet.table.name = "joints";
  for (std::size_t j = 0; j < robot.skeleton->joints.size(); ++j) {
    const JointModel& joint = robot.skeleton->joints[j];
    if (joint.type == JointType::kBall) continue;
    sheet.add(joint.name + "/position", [j](const Simulation& sim) {
      return sim.measured_joint_position(static_cast<int>(j));
    });
  }
  return sheet;
}

Sheet ball_sheet(const RobotModel& robot) {
  Sheet sheet;
  sheet.table.name = "spherical_joints";
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.type != JointType::kBall) continue;
    const char* const quantities[] = {"/w", "/x", "/y", "/z"};
    for (int k = 0; k < 4; ++k) {
      sheet.add(joint.name + quantities[k],
                [at = joint.position_offset + k](const Simulation& sim) {
                  return sim.read_positions()[at];
                });
    }
  }
  return sheet;
}

}  // namespace

Dataset simulated_recording(const std::shared_ptr<const RobotModel>& robot, const Dataset& commands,
                            std::uint64_t seed, const ExperimentOptions& options) {
  const Replay input(robot, commands, ReplayMode::kReference);
  auto own = std::make_shared<RobotModel>(*robot);
  own->sensors.seed = seed;
  Simulation sim(own);
  input.start(sim);
  Replay::Run run(input, sim);
  std::vector<Sheet> sheets = {muscle_sheet(*robot), joint_sheet(*robot), ball_sheet(*robot)};
  const auto steps = static_cast<std::int64_t>(std::llround(input.duration() / robot->step));
  const auto every =
      std::max<std::int64_t>(1, std::llround(options.recording_period / robot->step));
  for (std::int64_t k = 0; k <= steps; ++k) {
    const double time = static_cast<double>(k) * robot->step;
    if (k % every == 0) {
      for (Sheet& sheet : sheets) sheet.write_row(sim, time);
    }
    run.drive(time);
    sim.step();
  }
  Dataset recording = commands;
  for (Sheet& sheet : sheets) {
    if (!sheet.sources.empty()) recording.tables.push_back(std::move(sheet.table));
  }
  return recording;
}

}  // namespace discovery
}  // namespace anthrob
