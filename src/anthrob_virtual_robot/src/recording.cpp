#include "recording.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace anthrob::virtual_robot {
namespace {

constexpr int kDigits = 9;

/// Row by row, one string for the whole file.
class Csv final {
 public:
  Csv() { out_.precision(kDigits); }
  void head(const std::string& name) { out_ << (fresh_ ? "" : ",") << name, fresh_ = false; }
  void cell(double value) { out_ << (fresh_ ? "" : ",") << value, fresh_ = false; }
  void cell(const char* word) { out_ << (fresh_ ? "" : ",") << word, fresh_ = false; }
  void end_row() { out_ << "\n", fresh_ = true; }

  void save(const std::filesystem::path& file) const {
    std::ofstream stream(file);
    stream << out_.str();
    stream.close();
    if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
  }

 private:
  std::ostringstream out_;
  bool fresh_ = true;
};

Csv commands_table(const Recording& recording, const std::vector<std::string>& names) {
  Csv csv;
  csv.head("t");
  for (const std::string& name : names) csv.head(name + "/mode"), csv.head(name + "/reference");
  csv.end_row();
  for (const Command& command : recording.commands) {
    csv.cell(command.t);
    for (const double reference : command.references) csv.cell("POSITION"), csv.cell(reference);
    csv.end_row();
  }
  return csv;
}

Csv muscles_table(const Recording& recording, const std::vector<std::string>& names) {
  Csv csv;
  csv.head("t");
  for (const std::string& name : names) {
    for (const char* quantity : {"/position", "/velocity", "/current", "/voltage", "/force"}) {
      csv.head(name + quantity);
    }
  }
  csv.end_row();
  for (const Sample& sample : recording.samples) {
    csv.cell(sample.t);
    for (std::size_t i = 0; i < names.size(); ++i) {
      const MuscleReading& muscle = sample.readings.muscles[i];
      csv.cell(muscle.position), csv.cell(muscle.velocity), csv.cell(muscle.current);
      csv.cell(sample.voltages[i]), csv.cell(muscle.force);
    }
    csv.end_row();
  }
  return csv;
}

Csv joints_table(const Recording& recording) {
  Csv csv;
  csv.head("t"), csv.head("elbow/position"), csv.end_row();
  for (const Sample& sample : recording.samples) {
    csv.cell(sample.t), csv.cell(sample.readings.elbow), csv.end_row();
  }
  return csv;
}

Csv spherical_joints_table(const Recording& recording, int every) {
  Csv csv;
  csv.head("t");
  for (const char* part : {"/w", "/x", "/y", "/z"}) csv.head(std::string("shoulder") + part);
  csv.end_row();
  for (std::size_t k = 0; k < recording.samples.size(); k += static_cast<std::size_t>(every)) {
    const Eigen::Quaterniond& q = recording.samples[k].readings.shoulder;
    csv.cell(recording.samples[k].t);
    csv.cell(q.w()), csv.cell(q.x()), csv.cell(q.y()), csv.cell(q.z()), csv.end_row();
  }
  return csv;
}

}  // namespace

Recording record(Robot* robot, const std::vector<Command>& commands, double seconds,
                 const RecordingSettings& settings) {
  const double period = robot->period();
  robot->place(commands.front().references);
  const auto settling = std::lround(settings.settle / period);
  for (long k = 0; k < settling; ++k) robot->tick();
  return follow(robot, commands, seconds, settings);
}

Recording follow(Robot* robot, const std::vector<Command>& commands, double seconds,
                 const RecordingSettings& settings) {
  const double period = robot->period();
  Recording recording;
  recording.commands = commands;
  const auto ticks = std::lround(seconds / period);
  std::size_t next = 0;
  for (long k = 0; k <= ticks; ++k) {
    const double t = period * static_cast<double>(k);
    if (k % settings.muscle_divider == 0) {
      recording.samples.push_back({t, robot->measured(), robot->voltages()});
    }
    for (; next < commands.size() && commands[next].t <= t + 0.5 * period; ++next) {
      robot->command(commands[next].references);
    }
    robot->tick();
  }
  return recording;
}

void write_dataset(const Recording& recording, const std::vector<std::string>& muscle_names,
                   const RecordingSettings& settings, const Meta& meta, const std::string& folder) {
  const std::filesystem::path path(folder);
  std::filesystem::create_directories(path);
  commands_table(recording, muscle_names).save(path / "commands.csv");
  muscles_table(recording, muscle_names).save(path / "muscles.csv");
  if (meta.has_elbow) joints_table(recording).save(path / "joints.csv");
  spherical_joints_table(recording, settings.mocap_divider / settings.muscle_divider)
      .save(path / "spherical_joints.csv");
  std::ofstream out(path / "meta.yaml");
  out << "robot: anthrob\nkind: " << meta.kind
      << "\nrate: 200\nstart: {reference: first, settle_s: " << meta.settle << "}\n";
  if (!meta.sensors.empty()) out << "sensors:\n" << meta.sensors;
  out.close();
  if (!out) throw std::runtime_error((path / "meta.yaml").string() + ": cannot be written");
}

}  // namespace anthrob::virtual_robot
