// Replays a recording's inputs in simulation and writes what the robot would have done.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "anthrob_core/files.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/extent.h"
#include "anthrob_recording/unanswered.h"
#include "anthrob_sim/model/recorded_model.h"
#include "anthrob_sim/replay/replay.h"
#include "anthrob_sim/tool.h"

namespace {

/// What no position is imposed on stays without voltage.
std::vector<std::string> motors_without_position(const anthrob::RobotModel& model,
                                                 const anthrob::Dataset& recording) {
  std::vector<std::string> remarks;
  for (const anthrob::MuscleModel& muscle : model.muscles) {
    if (!muscle.actuator->takes_input()) continue;
    if (!recording.series(muscle.name + "/position").empty()) continue;
    remarks.push_back(recording.folder + ": " + muscle.name +
                      "/position was not measured: its motor is let go");
  }
  return remarks;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Runs the inputs of a recording through the simulation. Writes the true values, without "
      "sensor noise, as a dataset folder.",
      "anthrob_replay");
  std::string model_file, in, out, mode = "reference";
  double step = 0.001;
  app.add_option("--model", model_file, "model to simulate")
      ->required()
      ->transform(tool::model_or_file());
  app.add_option("--in", in, "recording: a bag or a dataset folder")->required();
  app.add_option("--out", out, "dataset folder to write")->required();
  app.add_option("--dt", step, "simulation step [s]")->capture_default_str();
  app.add_option("--mode", mode, "recorded quantity that drives the simulation")
      ->check(CLI::IsMember({"reference", "voltage", "position", "posture"}))
      ->capture_default_str();
  return tool::run(app, argc, argv, [&]() -> int {
    const RobotDescription robot = RobotDescription::load(model_file);
    Dataset recording = load_recording(in);
    const auto model = build_recorded(robot, recording, {step, {}});
    tool::say(app, model->remarks);
    tool::say(app, recording.remarks);
    leave_out_unanswered(recording);
    const ReplayMode replay_mode = mode == "reference"  ? ReplayMode::kReference
                                   : mode == "voltage"  ? ReplayMode::kVoltage
                                   : mode == "position" ? ReplayMode::kPosition
                                                        : ReplayMode::kPosture;
    std::error_code none;
    if (place_of(in) == place_of(out) || std::filesystem::equivalent(in, out, none)) {
      throw BadInput("--out " + out + ": expected another folder than the recording");
    }
    recording.require_place(out);
    if (replay_mode == ReplayMode::kPosition || replay_mode == ReplayMode::kPosture) {
      tool::say(app, motors_without_position(*model, recording));
    }
    tool::Progress progress("replay");
    tool::interrupted();
    std::string failure;
    const Dataset result = replay(
        model, recording, replay_mode,
        [&](double share) {
          progress.update(share);
          return !tool::interrupted();
        },
        &failure);
    const auto cut = result.meta.other.find("cut_short");
    if (cut == result.meta.other.end()) {
      result.save(out);
      std::cout << "wrote " << out << ": " << extent_of(result) << "\n";
      return tool::kDone;
    }
    const bool any = std::any_of(result.tables.begin(), result.tables.end(),
                                 [](const Table& table) { return !table.t.empty(); });
    if (any) result.save(out);
    std::cerr << "anthrob_replay: " << (failure.empty() ? "interrupted" : failure)
              << (any ? "; the part until then was written to " + out : "; nothing was written")
              << "\n";
    return failure.empty() ? tool::kInterrupted : tool::kFailed;
  });
}
