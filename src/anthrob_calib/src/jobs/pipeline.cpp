#include "jobs/pipeline.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <utility>

#include "anthrob_core/config_node.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace jobs {

namespace {

namespace fs = std::filesystem;

/// Options that a pipeline decides.
constexpr const char* kDecided[] = {"--start", "--evaluate"};

Stage load_stage(const ConfigNode& node, const fs::path& folder) {
  const auto path_at = [&](const char* key) {
    return (folder / node.text(key)).lexically_normal().string();
  };
  Stage stage;
  stage.name = node.text("name");
  if (!is_snake_case(stage.name)) {
    node.at("name").fail_expected("lower snake case, such as tier1_statics");
  }
  stage.config = path_at("config");
  stage.data = path_at("data");
  if (node.has("validation")) stage.validation = path_at("validation");
  if (!node.has("options")) return stage;
  for (const ConfigNode& option : node.at("options").items()) {
    stage.options.push_back(option.as_text());
    for (const char* decided : kDecided) {
      if (stage.options.back() == decided) {
        option.fail_expected("an option that the order of stages leaves open");
      }
    }
  }
  return stage;
}

/// "look at these parameters: ..." and the like.
bool is_doubtful(const FinishedRun& run) {
  return run.headline.rfind("usable", 0) != 0;
}

}  // namespace

std::vector<Stage> load_stages(const std::string& file) {
  const ConfigNode node = ConfigNode::load(file);
  const fs::path folder = fs::absolute(file).parent_path();
  std::vector<Stage> stages;
  std::set<std::string> names;
  for (const ConfigNode& item : node.at("stages").items()) {
    stages.push_back(load_stage(item, folder));
    if (!names.insert(stages.back().name).second) item.at("name").fail_expected("another name");
  }
  if (stages.empty()) node.at("stages").fail_expected("at least one stage");
  node.refuse_unknown_keys();
  return stages;
}

std::vector<std::string> files_of(const std::vector<Stage>& stages) {
  std::vector<std::string> files;
  for (const Stage& stage : stages) {
    append(extended_files(stage.config), files);
    const std::string model = ConfigNode::load(stage.config).text_or("model", "");
    if (!model.empty()) append(extended_files(fs::path(stage.config).parent_path() / model), files);
  }
  return files;
}

FinishedRun FinishedRun::read(std::uint64_t seed, const std::string& result,
                              const std::string& headline) {
  std::ifstream in(result);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  const auto fitness = json.is_object() && json.contains("fitness") ? json["fitness"] : json;
  const auto has = [&](const char* key) {
    return fitness.is_object() && fitness.contains(key) && fitness[key].is_number();
  };
  if (!has("after")) throw std::runtime_error(result + ": has no fitness of a calibration");
  FinishedRun run{seed, result, headline};
  run.after = fitness["after"].get<double>();
  run.before = has("before") ? fitness["before"].get<double>() : HUGE_VAL;
  return run;
}

const FinishedRun& better(const std::vector<FinishedRun>& runs) {
  return *std::min_element(
      runs.begin(), runs.end(),
      [](const FinishedRun& a, const FinishedRun& b) { return a.after < b.after; });
}

Pipeline::Pipeline(std::vector<Stage> stages, const std::string& out, std::uint64_t seed,
                   std::int64_t jobs)
    : stages_(std::move(stages)), out_(out), seed_(seed), jobs_(jobs), finished_(1) {}

std::optional<std::string> Pipeline::name() const {
  if (finished_.size() > stages_.size()) return std::nullopt;
  return stage().name + ", seed " + std::to_string(seed());
}

std::string Pipeline::folder() const {
  return (fs::path(out_) / stage().name / ("seed_" + std::to_string(seed()))).string();
}

JobCommand Pipeline::command() const {
  CalibrateOrder order;
  order.config = stage().config;
  order.data = stage().data;
  order.validation = stage().validation;
  order.out = folder();
  order.jobs = jobs_;
  order.seed = static_cast<std::int64_t>(seed());
  order.options = stage().options;
  if (finished_.size() > 1) {
    const FinishedRun& start = better(finished_[finished_.size() - 2]);
    order.options.insert(order.options.end(), {"--start", start.result});
  }
  return command_of(order);
}

void Pipeline::finish(const std::string& headline) {
  const std::string result = (fs::path(folder()) / "result.json").string();
  finished_.back().push_back(FinishedRun::read(seed(), result, headline));
  if (finished_.back().size() == kRuns) finished_.emplace_back();
}

double Pipeline::share(double of_run) const {
  const auto done = static_cast<double>((finished_.size() - 1) * kRuns + finished_.back().size());
  return (done + of_run) / static_cast<double>(stages_.size() * kRuns);
}

std::string Pipeline::headline() const {
  const std::size_t last = stages_.size() - 1;
  std::vector<std::string> doubtful;
  for (std::size_t s = 0; s < last; ++s) {
    if (is_doubtful(better(finished_[s]))) doubtful.push_back(stages_[s].name);
  }
  const std::string verdict = better(finished_[last]).headline;
  return doubtful.empty() ? verdict : verdict + "; look at the reports of " + joined(doubtful);
}

OutputFiles Pipeline::files() const {
  nlohmann::ordered_json json;
  json["headline"] = headline();
  json["stages"] = nlohmann::ordered_json::array();
  std::string remarks;
  for (std::size_t s = 0; s < stages_.size(); ++s) {
    const FinishedRun& kept = better(finished_[s]);
    nlohmann::ordered_json runs = nlohmann::ordered_json::array();
    for (const FinishedRun& run : finished_[s]) {
      runs.push_back({{"seed", run.seed},
                      {"result", fs::path(run.result).lexically_relative(out_).string()},
                      {"fitness", {{"before", run.before}, {"after", run.after}}},
                      {"headline", run.headline}});
    }
    json["stages"].push_back({{"name", stages_[s].name},
                              {"config", stages_[s].config},
                              {"data", stages_[s].data},
                              {"runs", runs},
                              {"kept", kept.seed}});
    remarks += "# " + stages_[s].name + ", seed " + std::to_string(kept.seed) + ": fitness " +
               short_number(kept.before) + " -> " + short_number(kept.after) + "\n";
  }
  const fs::path last = fs::path(better(finished_[stages_.size() - 1]).result).parent_path();
  const std::string extended = (last / "model.yaml").lexically_relative(out_).string();
  return {
      {"pipeline.json", json.dump(1) + "\n"},
      {"model.yaml", "# Calibrated in stages. pipeline.json has all runs, and each its report.\n" +
                         remarks + "extends: " + extended + "\n"}};
}

std::string Pipeline::summary() const {
  const bool complete = finished_.back().empty();
  const std::size_t s = finished_.size() - (complete ? 2 : 1);
  const FinishedRun& run = finished_[s].back();
  std::string line =
      stages_[s].name + ", seed " + std::to_string(run.seed) + ": " + run.headline + "\n";
  if (complete) {
    line += stages_[s].name + ": kept seed " + std::to_string(better(finished_[s]).seed) + "\n";
  }
  return line;
}

}  // namespace jobs
}  // namespace anthrob
