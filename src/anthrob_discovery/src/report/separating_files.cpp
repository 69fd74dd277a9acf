#include "report/separating_files.h"

#include <cmath>
#include <sstream>

namespace anthrob {
namespace discovery {

namespace {

std::string name_of(std::size_t number) {
  return "separating_" + std::to_string(number);
}

std::string postures_file_of(const std::string& name) {
  return name + "_postures.yaml";
}

void write_references(std::ostream& out, const RobotModel& model, const std::string& name,
                      const std::vector<double>& references) {
  out << "  - name: " << name << "\n    references: {";
  bool first = true;
  for (std::size_t m = 0; m < references.size(); ++m) {
    if (!model.muscles[m].has_controller) continue;
    out << (first ? "" : ", ") << model.muscles[m].name << ": " << references[m];
    first = false;
  }
  out << "}\n";
}

/// @param name of the protocol, "separating_1"
std::string protocol_yaml(const std::string& name, const std::string& explanation,
                          const std::string& rival) {
  return "# Tells " + explanation + " from " + rival +
         ". Written by anthrob_discover.\n"
         "# Start the driver, then record the robot:\n"
         "#   roslaunch anthrob_bringup record.launch protocol:=" +
         name + " protocol_file:=/whole/path/to/" + name +
         ".yaml \\\n"
         "#       out:=/whole/path/to/more sim:=false lock_step:=false enable:=true\n"
         "# Add tier:=1 for Anthrob without the forearm, or robot:=NAME model:=NAME for another "
         "robot.\n"
         "# Then run anthrob_discover again with some of the new runs in --train and the others in "
         "--test.\n"
         "protocol: trajectories\n"
         "postures: " +
         postures_file_of(name) +
         "\nrest: rest\n"
         "settle: {actuator_velocity: 0.02, joint_velocity: 0.01, window: 0.5, timeout: 20.0}\n"
         "hold: 0.5\n"
         "average: 0.1\n"
         "drift: {limit: 0.0524, redo: 1}\n";
}

std::string postures_yaml(const RobotModel& model, const SeparatingRecording& plan) {
  std::ostringstream out;
  out.precision(6);
  out << "# References of the motors [rad]: the rest posture, then the best one first. In nat: the "
         "evidence that a posture\n# is expected to bring.\n"
         "postures:\n";
  write_references(out, model, "rest", plan.rest);
  for (const SeparatingRecording::Target& target : plan.targets) {
    out << "  # " << std::llround(target.distance) << " nat\n";
    write_references(out, model, target.name, target.references);
  }
  return out.str();
}

}  // namespace

std::string separating_file(std::size_t number) {
  return name_of(number) + ".yaml";
}

std::map<std::string, std::string> separating_files(const Answer& answer, const RobotModel& model) {
  std::map<std::string, std::string> files;
  for (std::size_t i = 0; i < answer.effects.size(); ++i) {
    const FoundEffect& effect = answer.effects[i];
    const SeparatingRecording& plan = effect.separating_recording;
    if (plan.targets.empty()) continue;
    const std::string name = name_of(i + 1);
    const Rival& rival = effect.rivals.front();
    files[separating_file(i + 1)] =
        protocol_yaml(name, effect.id + " @ " + effect.place, rival.id + " @ " + rival.place);
    files[postures_file_of(name)] = postures_yaml(model, plan);
  }
  return files;
}

}  // namespace discovery
}  // namespace anthrob
