// Recordings of a virtual robot for the study of calibration: equilibria, trajectories and a
// trajectory to validate by, as the recorder would have made them.
#include <filesystem>
#include <iostream>

#include "blind_case.h"
#include "session.h"
#include "tool.h"

int main(int argc, char** argv) {
  using namespace anthrob::virtual_robot;
  CLI::App app("Makes recordings of a virtual robot for the study of calibration.",
               "anthrob_virtual_robot");
  std::string out, model, config;
  std::uint64_t seed = 1;
  int tier = 1;
  app.add_option("--seed", seed, "number of the robot: seed of its errors and of the noise");
  app.add_option("--tier", tier, "1: forearm detached, 2: the whole arm")
      ->check(CLI::IsMember({1, 2}));
  app.add_option("--model", model,
                 "model, to which errors are added; its folder has the other files that are read")
      ->required()
      ->transform(anthrob::tool::model_or_file());
  app.add_option("--config", config,
                 "settings; default: virtual_robot_tables.yaml beside the model");
  app.add_option("--out", out, "folder for equilibria, trajectories, validation")->required();
  return run_tool(app, argc, argv, [&] {
    const auto plain = load_arm(model);
    const auto folder = std::filesystem::weakly_canonical(model).parent_path();
    const auto settings = CalibrationRobotSettings::load(
        config.empty() ? (folder / "virtual_robot_tables.yaml").string() : config);
    const SensorSettings sensors =
        CaseSettings::load((folder / "virtual_robot.yaml").string()).sensors;
    const auto arm_of = [&](const auto& arm) { return tier == 1 ? detached(arm) : arm; };
    const auto built = arm_of(with_table_errors(plain, settings, seed));
    Session session(
        [&](std::uint64_t run) {
          return Robot(with_hidden(built, settings), &sensors, 1000 * seed + run);
        },
        arm_of(plain), settings, tier == 2);
    const std::string number = std::to_string(tier);
    session.find_references(load_targets((folder / ("equilibria_tier" + number + ".yaml")).string(),
                                         settings.lowest_tension));
    session.record_equilibria(out + "/equilibria");
    if (tier == 1) {
      session.record_trajectories({}, out + "/trajectories");
      session.record_tour({"E3", "E11", "E6", "E14"}, 1.2, "validation_run1", out + "/validation");
    } else {
      session.record_trajectories({"E1", "E3", "E5"}, out + "/trajectories");
      session.record_tour({"E5", "E2", "E3"}, 1.2, "validation_run1", out + "/validation");
    }
  });
}
