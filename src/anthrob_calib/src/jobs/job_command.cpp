#include "jobs/job_command.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace jobs {

namespace {

namespace fs = std::filesystem;

void require_given(const std::string& field, bool given, const std::string& what) {
  if (!given) throw BadInput(field + ": missing; expected " + what);
}

void require_whole(const std::string& field, const std::string& path) {
  if (path.empty() || fs::path(path).is_absolute()) return;
  throw BadInput(field + ": " + path + ": expected a whole path, such as /home/me/" + path);
}

/// A model may also be a name, such as anthrob/II.
void require_model(const std::string& model) {
  if (fs::path(model).extension() == ".yaml") require_whole("model", model);
}

void require_not_negative(const std::string& field, std::int64_t value) {
  if (value >= 0) return;
  throw BadInput(field + ": " + std::to_string(value) +
                 ": expected a whole number from 1, or 0 for the program's own");
}

/// @param own options that come from fields
void require_other_options(const std::vector<std::string>& options,
                           const std::vector<std::string>& own) {
  for (const std::string& option : options) {
    const std::string name = option.substr(0, option.find('='));
    if (std::find(own.begin(), own.end(), name) == own.end()) continue;
    throw BadInput("options: " + name + ": expected in the field " + name.substr(2));
  }
}

void add(const std::string& option, const std::string& value, std::vector<std::string>& words) {
  if (value.empty()) return;
  words.push_back(option);
  words.push_back(value);
}

void add(const std::string& option, std::int64_t value, std::vector<std::string>& words) {
  if (value > 0) add(option, std::to_string(value), words);
}

void add(const std::string& option, const std::vector<std::string>& values,
         std::vector<std::string>& words) {
  if (values.empty()) return;
  words.push_back(option);
  words.insert(words.end(), values.begin(), values.end());
}

void require_recordings(const std::string& field, const std::vector<std::string>& recordings) {
  for (const std::string& recording : recordings) {
    require_given(field, !recording.empty(), "the path of a recording instead of an empty one");
    require_whole(field, recording);
  }
}

/// Stages have configurations, recordings and options of their own.
JobCommand pipeline_command(const CalibrateOrder& order) {
  for (const auto& [field, value] :
       {std::pair{"config", order.config}, std::pair{"data", order.data},
        std::pair{"validation", order.validation}, std::pair{"model", order.model}}) {
    if (value.empty()) continue;
    throw BadInput(std::string(field) + ": " + value + ": expected in the file of the pipeline");
  }
  if (!order.options.empty()) {
    throw BadInput("options: " + order.options.front() + ": expected in the file of the pipeline");
  }
  require_given("out", !order.out.empty(), "a folder for the result");
  require_whole("pipeline", order.pipeline);
  require_whole("out", order.out);
  require_not_negative("jobs", order.jobs);
  require_not_negative("seed", order.seed);
  JobCommand command{"anthrob_calib", "anthrob_calibrate_pipeline", {}, order.out};
  add("--pipeline", order.pipeline, command.arguments);
  add("--out", order.out, command.arguments);
  add("--jobs", order.jobs, command.arguments);
  add("--seed", order.seed, command.arguments);
  return command;
}

}  // namespace

JobCommand command_of(const CalibrateOrder& order) {
  if (!order.pipeline.empty()) return pipeline_command(order);
  require_given("config", !order.config.empty(), "a configuration of the calibration");
  require_given("data", !order.data.empty(), "a folder of recordings to fit");
  require_given("out", !order.out.empty(), "a folder for the result");
  require_whole("config", order.config);
  require_whole("data", order.data);
  require_whole("validation", order.validation);
  require_whole("out", order.out);
  require_model(order.model);
  require_not_negative("jobs", order.jobs);
  require_not_negative("seed", order.seed);
  const auto& options = order.options;
  require_other_options(
      options, {"--config", "--data", "--validation", "--model", "--out", "--jobs", "--seed"});
  if (std::count(options.begin(), options.end(), "--resume")) {
    throw BadInput("options: --resume: expected without; the same goal continues by itself");
  }
  JobCommand command{"anthrob_calib", "anthrob_calibrate", {}, order.out};
  add("--config", order.config, command.arguments);
  add("--data", order.data, command.arguments);
  add("--validation", order.validation, command.arguments);
  add("--model", order.model, command.arguments);
  add("--out", order.out, command.arguments);
  add("--jobs", order.jobs, command.arguments);
  add("--seed", order.seed, command.arguments);
  command.arguments.insert(command.arguments.end(), options.begin(), options.end());
  const bool searches = std::count(options.begin(), options.end(), "--evaluate") == 0;
  if (searches && fs::exists(fs::path(order.out) / "journal.txt")) {
    command.arguments.push_back("--resume");
  }
  return command;
}

JobCommand command_of(const DiscoverOrder& order) {
  require_given("model", !order.model.empty(), "a model to examine");
  require_given("train", !order.train.empty(), "recordings that are fitted");
  require_given("test", !order.test.empty(), "held-out recordings");
  require_given("out", !order.out.empty(), "a folder for the result");
  require_model(order.model);
  require_whole("calibration", order.calibration);
  require_whole("out", order.out);
  require_recordings("train", order.train);
  require_recordings("test", order.test);
  require_recordings("repeat", order.repeat);
  for (const std::string& recording : order.test) {
    if (!std::count(order.train.begin(), order.train.end(), recording)) continue;
    throw BadInput("test: " + recording + ": is also in train; expected recordings that are not");
  }
  require_not_negative("jobs", order.jobs);
  require_not_negative("seed", order.seed);
  require_other_options(order.options, {"--model", "--calibration", "--train", "--test", "--repeat",
                                        "--out", "--jobs", "--seed"});
  JobCommand command{"anthrob_discovery", "anthrob_discover", {}, order.out};
  add("--model", order.model, command.arguments);
  add("--calibration", order.calibration, command.arguments);
  add("--train", order.train, command.arguments);
  add("--test", order.test, command.arguments);
  add("--repeat", order.repeat, command.arguments);
  add("--out", order.out, command.arguments);
  add("--jobs", order.jobs, command.arguments);
  add("--seed", order.seed, command.arguments);
  command.arguments.insert(command.arguments.end(), order.options.begin(), order.options.end());
  return command;
}

JobCommand command_of(const HealthOrder& order) {
  require_given("model", !order.model.empty(), "a model of the robot");
  require_given("out", !order.out.empty(), "a folder for the robot's history");
  require_model(order.model);
  require_whole("out", order.out);
  return {"anthrob_calib",
          "anthrob_health_test",
          // All of them: one of an earlier run may still be on the server.
          {"_model:=" + order.model, "_out:=" + order.out, "_largest_turn:=2", "_lock_step:=false",
           "__ns:=" + order.robot},
          order.out,
          true};
}

}  // namespace jobs
}  // namespace anthrob
