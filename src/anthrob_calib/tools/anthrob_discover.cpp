// Where do a model and recordings disagree, and which physical effect is missing?
#include <filesystem>
#include <iostream>
#include <thread>

#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_sim/recording/load_recording.h"
#include "anthrob_sim/tool/tool.h"

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app("Finds the physical effect that a model misses in recordings.", "anthrob_discover");
  discovery::Question question;
  std::vector<std::string> train, test, repeats;
  std::string out, calibration;
  question.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app.add_option("--model", question.model_file, "model file to be examined")->required();
  app.add_option("--train", train, "recordings to learn from")->required();
  app.add_option("--test", test, "recordings to judge by; not fitted")->required();
  app.add_option("--repeat", repeats, "further runs of the first --train's commands");
  app.add_option("--out", out, "folder for report.json, report.html and model.yaml")->required();
  app.add_option("--effects", question.effects, "consider only these ids")->delimiter(',');
  app.add_option("--max-effects", question.max_effects, "stop after so many")
      ->check(CLI::Range(0, 20))
      ->capture_default_str();
  app.add_option("--jobs", question.jobs, "threads")->check(CLI::Range(1, 1024));
  app.add_option("--seed", question.seed, "of resampling")->capture_default_str();
  app.add_option("--calibration", calibration,
                 "ordinary parameters (default: calibration.yaml beside the model)");
  app.add_option("--dt", question.step, "simulation step [s]")->capture_default_str();
  return tool::run(app, argc, argv, [&]() -> int {
    if (calibration.empty()) {
      const auto beside =
          std::filesystem::path(question.model_file).parent_path() / "calibration.yaml";
      if (std::filesystem::exists(beside)) calibration = beside.string();
    }
    if (!calibration.empty()) {
      question.nuisances = read_parameters(ConfigNode::load(calibration).at("parameters"),
                                           ConfigNode::load(question.model_file));
    }
    for (const std::string& r : train) question.train.push_back(load_recording(r));
    for (const std::string& r : test) question.test.push_back(load_recording(r));
    for (const std::string& r : repeats) question.repeats.push_back(load_recording(r));
    tool::interrupted();
    discovery::Evaluator evaluator(question.model_file, question.nuisances, question.step,
                                   question.jobs);
    evaluator.on_progress([](double) { return !tool::interrupted(); });
    question.progress = [](const std::string& what, double) {
      std::cerr << what << "\n";
      return !tool::interrupted();
    };
    const discovery::Answer answer = discover(evaluator, question);
    std::cout << answer.verdict << "\n";
    for (const auto& effect : answer.effects) {
      std::cout << effect.id << " @ " << effect.place << " p=" << effect.probability
                << " evidence=" << effect.evidence << "\n";
      for (const auto& p : effect.parameters) {
        std::cout << "  " << p.name << " = " << p.value << " [" << p.low << ", " << p.high << "] "
                  << p.unit << "\n";
      }
      for (const auto& r : effect.rivals) {
        std::cout << "  rival " << r.id << " @ " << r.place << " p=" << r.probability << " "
                  << r.evidence << "\n";
      }
    }
    std::cout << "train gap " << answer.train.before << " -> " << answer.train.recalibrated
              << " -> " << answer.train.after << ", test " << answer.test.before << " -> "
              << answer.test.recalibrated << " -> " << answer.test.after << "\n";
    return tool::kDone;
  });
}
