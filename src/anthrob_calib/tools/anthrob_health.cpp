// The test of tendons without a robot: its commands, and what a recording of it says.
#include <iostream>

#include "anthrob_recording/bag.h"
#include "anthrob_sim/simulation.h"
#include "anthrob_sim/tool.h"
#include "health/health_report.h"

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Tests of tendons (docs/health.md). `commands` writes what the test asks of the motors; "
      "`judge` adds a recording of it to the history of the robot.",
      "anthrob_health");
  app.require_subcommand(1);
  std::string model_file, in, out, time;
  CLI::App* commands =
      app.add_subcommand("commands", "the commands of a test, as a dataset folder");
  CLI::App* judge = app.add_subcommand("judge", "figures of a recorded test, and what has changed");
  for (CLI::App* command : {commands, judge}) {
    command->add_option("--model", model_file, "model of the robot")
        ->required()
        ->transform(tool::model_or_file());
  }
  commands->add_option("--out", out, "dataset folder to write")->required();
  judge->add_option("--in", in, "recording of a test: a bag or a dataset folder")->required();
  judge->add_option("--history", out, "folder of health.csv, health.json and health.html")
      ->required();
  judge->add_option("--time", time, "of the test, such as 2026-12-01T08:30:00Z (default: now)");
  return tool::run(app, argc, argv, [&]() -> int {
    const auto model = tool::load_model(app, model_file);
    if (commands->parsed()) {
      const health::TestProtocol protocol(model, Simulation(model).configuration(), {});
      const Dataset data = protocol.commands();
      data.require_place(out);
      data.save(out);
      std::cout << "wrote " << out << ": " << protocol.duration() << " s\n";
      return tool::kDone;
    }
    const double day = time.empty() ? health::present_day() : health::day_of(time);
    const Dataset recording = load_recording(in);
    tool::say(app, recording.remarks);
    const health::TestProtocol protocol(model, health::posture_of(model, recording), {});
    const auto report =
        health::add_to_history(out, model->name, day, health::measure(protocol, recording), {});
    std::cout << report.headline << "\n";
    for (const std::string& line : report.lines) std::cout << "  " << line << "\n";
    return tool::kDone;
  });
}
