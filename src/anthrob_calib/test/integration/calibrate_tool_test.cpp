// anthrob_calibrate as a user sees it: equal bits however it is run, and one clear line for bad
// input, with nothing lost.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "anthrob_core/testing/content.h"
#include "anthrob_core/testing/interrupt.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/bag.h"
#include "integration/tool_outcome.h"
#include "simulated_recordings.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;
using testing_support::Outcome;

const std::string kRig = std::string(ANTHROB_CONFIG_DIR) + "/two_muscle_rig/model_II.yaml";

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
}

class CalibrateTool : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = fs::temp_directory_path() / ("anthrob_calibrate_" + std::to_string(getpid()));
    fs::create_directories(root_);
    LoadOptions truth;
    truth.overrides = {{"muscles.flexor.rest_tendon_length", 0.3625},
                       {"muscles.extensor.spindle_radius", 0.0069}};
    const auto robot = load_robot_model(kRig, truth);
    for (const double to : {0.0, 2.0, 3.0}) {
      RecordingPlan plan;
      plan.from = {1.0, 1.0};
      plan.to = {to, 2.0 - to};
      plan.duration = 1.0;
      plan.force_noise = 0.1;
      record_simulation(robot, plan).save(path("eq/E" + std::to_string(int(to))));
      plan.kind = "trajectory";
      plan.duration = 1.2;  // a recording of its own
      record_simulation(robot, plan).save(path("tr/E1_to_E" + std::to_string(int(to))));
    }
    write_config("c.yaml", "equilibria", 0.006);
    write_config("t.yaml", "trajectories", 0.006);
  }
  static void TearDownTestSuite() { fs::remove_all(root_); }

  static std::string path(const std::string& name) { return (root_ / name).string(); }

  static void write_config(const std::string& name, const std::string& kind, double range) {
    write(path(name), "model: " + fs::relative(kRig, root_).string() + "\nrecordings: " + kind +
                          "\nsimulate: {settle: 0.5, motion: 1.0}\n"
                          "optimiser: {method: evolution_strategy, parents: 2, offspring: 8, "
                          "generations: 5, seed: 3}\nparameters:\n"
                          "  - {path: muscles.*.rest_tendon_length, unit: m, range: " +
                          std::to_string(range) +
                          ", step: 0.001}\n"
                          "  - {path: muscles.*.spindle_radius, unit: m, low: 0.006, high: 0.0075, "
                          "step: 0.0002}\n");
  }

  static Outcome run(const std::string& arguments, const std::string& before = "") {
    const std::string errors = path("errors.txt");
    const int status = std::system(
        (before + ANTHROB_CALIBRATE + " " + arguments + " >/dev/null 2>" + errors).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(errors)};
  }

  static Outcome calibrate(const std::string& out, const std::string& more = "",
                           const std::string& before = "") {
    return run(
        "--config " + path("c.yaml") + " --data " + path("eq") + " --out " + path(out) + " " + more,
        before);
  }

  void expect_same(const std::string& a, const std::string& b) {
    for (const char* file : {"/result.json", "/model.yaml", "/report.html", "/journal.txt"}) {
      EXPECT_FALSE(content(path(a + file)).empty()) << a << file;
      EXPECT_EQ(content(path(a + file)), content(path(b + file))) << b << file;
    }
  }

  static fs::path root_;
};

fs::path CalibrateTool::root_;

TEST_F(CalibrateTool, BitsAreEqualHoweverItIsRun) {
  ASSERT_EQ(calibrate("one", "--jobs 1").status, 0);
  const auto result = nlohmann::json::parse(content(path("one/result.json")));
  EXPECT_LT(result["fitness"]["after"].get<double>(),
            0.5 * result["fitness"]["before"].get<double>());
  EXPECT_NO_THROW(load_robot_model(path("one/model.yaml")));

  EXPECT_EQ(calibrate("two", "--jobs 2").status, 0);
  expect_same("one", "two");

  // Killed in the middle: the journal of the first generations is what is left.
  ASSERT_EQ(calibrate("killed", "--jobs 2 --generations 2").status, 0);
  fs::remove(path("killed/result.json"));
  EXPECT_EQ(calibrate("killed", "--jobs 2 --resume").status, 0);
  expect_same("one", "killed");

  if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  const char* const mpirun =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 3 ";
  EXPECT_EQ(calibrate("hosts", "--jobs 1", mpirun).status, 0);
  expect_same("one", "hosts");

  // Begun on several, it goes on alone: what MPI loads is no other build.
  ASSERT_EQ(calibrate("left", "--jobs 1 --generations 2", mpirun).status, 0);
  const Outcome alone = calibrate("left", "--jobs 1 --resume");
  EXPECT_EQ(alone.status, 0);
  EXPECT_EQ(alone.errors, "");
  expect_same("one", "left");

  // All processes stop when one of them cannot go on.
  const Outcome unwritable =
      calibrate("c.yaml/below", "--jobs 1", std::string("timeout 30 env ") + mpirun);
  EXPECT_NE(unwritable.status, 0);
  EXPECT_NE(unwritable.status, 124) << "hangs";
  EXPECT_NE(unwritable.errors.find("c.yaml/below"), std::string::npos) << unwritable.errors;
}

/// The lines of progress that a command writes to descriptor 3, by key.
std::map<std::string, std::vector<std::string>> progress_in(const std::string& file) {
  std::map<std::string, std::vector<std::string>> told;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto json = nlohmann::json::parse(line);
    for (const auto& [key, value] : json.items()) {
      told[key].push_back(value.is_string() ? value.get<std::string>() : value.dump());
    }
  }
  return told;
}

TEST_F(CalibrateTool, TellsItsProgressToAProgram) {
  const std::string lines = path("progress.jsonl");
  const std::string listening = "exec 3>" + lines + "; ANTHROB_PROGRESS_FD=3 ";
  ASSERT_EQ(calibrate("told", "--brief", listening).status, 0);
  auto told = progress_in(lines);
  EXPECT_EQ(told["stage"], (std::vector<std::string>{"searching", "computing the errors"}));
  EXPECT_EQ(told["headline"].size(), 1u);
  EXPECT_TRUE(told["error"].empty());
  ASSERT_FALSE(told["best"].empty());
  const auto result = nlohmann::json::parse(content(path("told/result.json")));
  EXPECT_EQ(told["best"].back(),
            "fitness " + short_number(result["fitness"]["after"].get<double>()));
  ASSERT_GE(told["share"].size(), 2u);
  double before = 0.0;
  for (const std::string& share : told["share"]) {
    EXPECT_GE(std::stod(share), before);
    before = std::stod(share);
  }
  EXPECT_EQ(before, 0.9);  // what comes then has no share of its own

  const Outcome wrong = run("--config " + path("none.yaml") + " --data x --out y", listening);
  EXPECT_EQ(wrong.status, 2);
  EXPECT_EQ(progress_in(lines)["error"].at(0) + "\n", wrong.errors);

  // Who listens may end; a number that is no open file is nobody.
  EXPECT_EQ(
      calibrate("gone", "--brief",
                "rm -f " + path("pipe") + "; mkfifo " + path("pipe") + "; true <" + path("pipe") +
                    " & exec 3>" + path("pipe") + "; wait; ANTHROB_PROGRESS_FD=3 ")
          .status,
      0);
  EXPECT_EQ(calibrate("nobody", "--brief", "ANTHROB_PROGRESS_FD=3 ").status, 0);
  expect_same("told", "gone");
  expect_same("told", "nobody");
}

TEST_F(CalibrateTool, StagesGoOnToTheSameBits) {
  write(path("p.yaml"),
        "stages:\n  - {name: statics, config: c.yaml, data: eq, options: &o [--brief, "
        "--generations, 2]}\n"
        "  - {name: dynamics, config: t.yaml, data: tr, options: *o}\n");
  const auto pipeline = [&](const std::string& out, const std::string& before = "") {
    const std::string errors = path("errors.txt");
    const int status =
        std::system((before + ANTHROB_CALIBRATE_PIPELINE + " --pipeline " + path("p.yaml") +
                     " --out " + path(out) + " >/dev/null 2>" + errors)
                        .c_str());
    return Outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(errors)};
  };
  const Outcome whole = pipeline("stages");
  ASSERT_EQ(whole.status, 0) << whole.errors;
  const auto json = nlohmann::json::parse(content(path("stages/pipeline.json")));
  const auto& runs = json["stages"][0]["runs"];
  EXPECT_NE(runs[0]["fitness"]["after"], runs[1]["fitness"]["after"]);
  const bool second = runs[1]["fitness"]["after"] < runs[0]["fitness"]["after"];
  EXPECT_EQ(json["stages"][0]["kept"], second ? 2 : 1);
  // The second stage starts where the first one ended.
  const std::string kept =
      "stages/statics/seed_" + std::string(second ? "2" : "1") + "/result.json";
  const auto first = nlohmann::json::parse(content(path(kept)));
  const auto next = nlohmann::json::parse(content(path("stages/dynamics/seed_1/result.json")));
  EXPECT_EQ(next["parameters"][0]["initial"], first["parameters"][0]["value"]);
  EXPECT_NO_THROW(load_robot_model(path("stages/model.yaml")));

  const Outcome interrupted = pipeline(
      "parts", interrupted_when(path("parts/dynamics/seed_1/journal.txt"), path("when.sh")));
  ASSERT_TRUE(interrupt_was_sent(path("when.sh")));
  EXPECT_EQ(interrupted.status, 130) << interrupted.errors;
  EXPECT_NE(interrupted.errors.find("interrupted in dynamics, seed 1; run the same command again"),
            std::string::npos)
      << interrupted.errors;
  EXPECT_FALSE(fs::exists(path("parts/model.yaml")));
  EXPECT_EQ(pipeline("parts").status, 0);
  for (const char* file : {"/model.yaml", "/dynamics/seed_2/result.json"}) {
    EXPECT_EQ(content(path(std::string("parts") + file)),
              content(path(std::string("stages") + file)));
  }

  write(path("p.yaml"), "stages:\n  - {name: statics, config: none.yaml, data: eq}\n");
  const Outcome wrong = pipeline("wrong");
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.errors.find("none.yaml"), std::string::npos) << wrong.errors;
  EXPECT_EQ(wrong.lines(), 1);
}

TEST_F(CalibrateTool, LeastSquaresBeginsAnewOnResumeAndNothingIsOverwrittenWithoutIt) {
  ASSERT_EQ(calibrate("squares", "--optimiser least_squares").status, 0);
  const std::string result = content(path("squares/result.json"));
  const Outcome again = calibrate("squares", "--optimiser least_squares");
  EXPECT_EQ(again.status, 2);
  EXPECT_NE(again.errors.find("expected --resume"), std::string::npos) << again.errors;
  EXPECT_EQ(content(path("squares/result.json")), result);
  EXPECT_EQ(calibrate("squares", "--optimiser least_squares --resume").status, 0);
  EXPECT_EQ(content(path("squares/result.json")), result);
}

TEST_F(CalibrateTool, WhatAnotherProgramFoundIsFoundAnew) {
  ASSERT_EQ(calibrate("same", "--generations 2").status, 0);
  ASSERT_EQ(calibrate("other", "--generations 1").status, 0);
  std::string journal = content(path("other/journal.txt"));
  // Its fitnesses: of a program that calculated something else.
  for (std::size_t at = 0; (at = journal.find("0.00", at)) != std::string::npos;) {
    journal.replace(at, 4, "0.01");
  }
  write(path("other/journal.txt"), journal);
  const Outcome again = calibrate("other", "--generations 2 --resume",
                                  "LD_PRELOAD=" + std::string(ANTHROB_OTHER_LIBRARY) + " ");
  ASSERT_EQ(again.status, 0) << again.errors;
  EXPECT_NE(again.errors.find("by another build of the program"), std::string::npos)
      << again.errors;
  for (const char* file : {"/result.json", "/model.yaml"}) {
    EXPECT_EQ(content(path("same") + file), content(path("other") + file)) << file;
  }
}

TEST_F(CalibrateTool, EvaluatingLeavesAFinishedCalibrationAlone) {
  ASSERT_EQ(calibrate("finished", "--generations 1 --brief").status, 0);
  const std::string model = content(path("finished/model.yaml"));
  const Outcome outcome = calibrate("finished", "--evaluate");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.errors.find("expected another --out"), std::string::npos) << outcome.errors;
  // There is no search to go on with.
  EXPECT_EQ(calibrate("errors_of_none", "--evaluate --resume").status, 2);
  EXPECT_EQ(content(path("finished/model.yaml")), model);
  EXPECT_EQ(calibrate("errors_only", "--evaluate").status, 0);
  EXPECT_EQ(calibrate("errors_only", "--evaluate").status, 0) << "again";
}

TEST_F(CalibrateTool, KeysOfARecordingThatNobodyKnowsAreMentioned) {
  fs::copy(path("eq"), path("described"), fs::copy_options::recursive);
  const fs::path meta = fs::path(path("described")) / "E2/meta.yaml";
  write(meta, content(meta) + "weather: fine\n");
  const Outcome outcome = run("--config " + path("c.yaml") + " --data " + path("described") +
                              " --out " + path("mentioned") + " --evaluate");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.errors,
            "anthrob_calibrate: " + meta.string() + ": weather: unknown key, kept\n");
}

TEST_F(CalibrateTool, NothingThatIsReadIsReplaced) {
  const auto refused = [](const std::string& out, const std::string& more, const char* file) {
    const std::string before = content(path(out + "/" + file));
    const Outcome outcome = calibrate(out, more);
    EXPECT_EQ(outcome.status, 2) << more;
    EXPECT_NE(outcome.errors.find(std::string(file) +
                                  " is an input of this run and would be overwritten"),
              std::string::npos)
        << outcome.errors;
    EXPECT_EQ(content(path(out + "/" + file)), before);
  };
  // Written by hand, in the folder for what is found.
  fs::create_directories(path("mine"));
  write(path("mine/model.yaml"), "extends: " + kRig + "\n");
  const std::string model = "--model " + path("mine/model.yaml");
  refused("mine", model, "model.yaml");
  refused("mine", "--evaluate " + model, "model.yaml");
  fs::create_directory_symlink(path("mine"), path("link"));
  refused("link", model, "model.yaml");
  EXPECT_FALSE(fs::exists(path("mine/journal.txt")));

  // What the model extends, also where nothing of it is left.
  write(path("further.yaml"), "extends: [" + kRig + ", mine/model.yaml]\n");
  refused("mine", "--model " + path("further.yaml"), "model.yaml");

  ASSERT_EQ(calibrate("earlier", "--generations 1 --brief").status, 0);
  fs::remove(path("earlier/journal.txt"));
  refused("earlier", "--start " + path("earlier/result.json"), "result.json");
}

TEST_F(CalibrateTool, BriefItFindsTheSameAndLeavesOutWhatComesAfterTheSearch) {
  ASSERT_EQ(calibrate("long").status, 0);
  ASSERT_EQ(calibrate("brief", "--brief").status, 0);
  EXPECT_EQ(content(path("brief/model.yaml")), content(path("long/model.yaml")));
  const auto with = nlohmann::json::parse(content(path("long/result.json")));
  const auto without = nlohmann::json::parse(content(path("brief/result.json")));
  EXPECT_EQ(without["calibration"], with["calibration"]);
  EXPECT_TRUE(with.contains("identifiability"));
  EXPECT_FALSE(without.contains("identifiability"));
}

TEST_F(CalibrateTool, InterruptedItKeepsTheBestAndGoesOn) {
  ASSERT_EQ(calibrate("whole", "--generations 40").status, 0);
  const Outcome stopped =
      calibrate("stopped", "--generations 40",
                interrupted_when(path("stopped/journal.txt"), path("interrupt.sh")));
  ASSERT_EQ(stopped.status, 130) << stopped.errors;
  EXPECT_NE(stopped.errors.find("--resume continues"), std::string::npos) << stopped.errors;
  EXPECT_TRUE(fs::exists(path("stopped/model.yaml")));
  EXPECT_EQ(calibrate("stopped", "--generations 40 --resume").status, 0);
  expect_same("whole", "stopped");
}

TEST_F(CalibrateTool, InterruptedAfterTheSearchItHasTheResultButNoErrorsOfParameters) {
  const std::string more = "--optimiser least_squares --jobs 1";
  const std::string script = path("interrupt.sh");
  const Outcome stopped =
      calibrate("errors", more, interrupted_when(path("errors/model.yaml.partial"), script));
  ASSERT_TRUE(interrupt_was_sent(script)) << "finished too early: make the work longer";
  ASSERT_EQ(stopped.status, 130) << stopped.errors;
  EXPECT_NE(stopped.errors.find("before the errors of the parameters"), std::string::npos)
      << stopped.errors;
  const auto result = nlohmann::json::parse(content(path("errors/result.json")));
  EXPECT_LT(result["fitness"]["after"].get<double>(),
            0.5 * result["fitness"]["before"].get<double>());
  EXPECT_TRUE(fs::exists(path("errors/residuals.bin")));
  EXPECT_EQ(calibrate("errors", more + " --resume").status, 0);
  ASSERT_EQ(calibrate("errors_whole", more).status, 0);
  expect_same("errors", "errors_whole");
  EXPECT_FALSE(fs::exists(path("errors/residuals.bin")));
}

TEST_F(CalibrateTool, OnAFullDiskThereIsNoModelWithoutItsErrors) {
  ASSERT_EQ(calibrate("roomy", "--generations 1 --brief").status, 0);
  EXPECT_FALSE(fs::exists(path("roomy/model.yaml.partial")));
  const auto kilobytes = fs::file_size(path("roomy/result.json")) / 1024;
  ASSERT_GT(kilobytes, fs::file_size(path("roomy/journal.txt")) / 1024);
  // No file may grow further than that.
  const std::string full =
      "bash -c 'trap \"\" XFSZ; ulimit -f " + std::to_string(kilobytes) + "; exec \"$@\"' full ";
  const Outcome outcome = calibrate("full", "--generations 1 --brief", full);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.errors.find("cannot be written: File too large"), std::string::npos)
      << outcome.errors;
  for (const char* file : {"/model.yaml", "/result.json", "/report.html"}) {
    EXPECT_FALSE(fs::exists(path("full") + file)) << file;
  }
  EXPECT_NO_THROW(load_robot_model(path("full/model.yaml.partial")));
  EXPECT_EQ(calibrate("full", "--generations 1 --brief --resume").status, 0);
  expect_same("full", "roomy");
  EXPECT_FALSE(fs::exists(path("full/model.yaml.partial")));
}

TEST_F(CalibrateTool, ADamagedJournalIsRefusedByItsLine) {
  ASSERT_EQ(calibrate("damaged", "--generations 2 --brief").status, 0);
  const std::string journal = content(path("damaged/journal.txt"));
  std::string better = journal;  // its fifth line
  std::size_t line = 0;
  for (int i = 1; i < 5; ++i) line = better.find('\n', line) + 1;
  const std::size_t fitness = better.find(' ', line) + 1;
  better.replace(fitness, better.find(' ', fitness) - fitness, "1e-30");
  write(path("damaged/journal.txt"), better);
  const Outcome refused = calibrate("damaged", "--generations 2 --brief --resume");
  EXPECT_EQ(refused.status, 2);
  EXPECT_EQ(refused.lines(), 1) << refused.errors;
  EXPECT_NE(refused.errors.find("journal.txt:5: damaged"), std::string::npos) << refused.errors;
  write(path("damaged/journal.txt"), journal.substr(0, journal.size() - 9));
  const Outcome resumed = calibrate("damaged", "--generations 2 --brief --resume");
  EXPECT_EQ(resumed.status, 0);
  EXPECT_NE(resumed.errors.find("the last line is damaged"), std::string::npos) << resumed.errors;
  EXPECT_EQ(content(path("damaged/journal.txt")), journal);
}

TEST_F(CalibrateTool, InterruptedWhileItReplaysItEndsAtOnce) {
  for (const char* name : {"E0", "E2", "E3"}) {
    Dataset recording = Dataset::load(path("eq/") + name);
    recording.meta.settle_s = 3600.0;  // the most that is accepted: an hour to simulate
    recording.save(path("rested/") + name);
  }
  const auto start = std::chrono::steady_clock::now();
  const Outcome outcome = run("--config " + path("c.yaml") + " --data " + path("rested") +
                                  " --out " + path("rested_errors") + " --evaluate",
                              "timeout --preserve-status -k 100 -s TERM 3 ");
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(outcome.status, 130) << outcome.errors;
  EXPECT_LT(took.count(), 30.0);
  EXPECT_NE(outcome.errors.find("interrupted before the errors on all recordings were computed"),
            std::string::npos)
      << outcome.errors;
  EXPECT_EQ(outcome.errors.find("--resume"), std::string::npos) << outcome.errors;
  const auto result = nlohmann::json::parse(content(path("rested_errors/result.json")));
  EXPECT_TRUE(result["calibration"].is_null());
}

TEST_F(CalibrateTool, TrajectoriesValidationAndStart) {
  ASSERT_EQ(calibrate("first").status, 0);
  const Outcome outcome =
      run("--config " + path("t.yaml") + " --data " + path("tr") + " --validation " + path("eq") +
          " --start " + path("first/result.json") + " --out " + path("second"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  const auto first = nlohmann::json::parse(content(path("first/result.json")));
  const auto second = nlohmann::json::parse(content(path("second/result.json")));
  EXPECT_EQ(second["parameters"][0]["initial"], first["parameters"][0]["value"]);
  EXPECT_EQ(second["drives"].size(), 3u);
  EXPECT_TRUE(second["validation"].is_object());
  const std::string html = content(path("second/report.html"));
  EXPECT_NE(html.find("On held-out recordings"), std::string::npos);
  EXPECT_LT(html.find("Held-out"), html.find("Recordings of the calibration"));
  EXPECT_EQ(html.find("nan"), std::string::npos);
}

TEST_F(CalibrateTool, BadInputIsOneLineAndNothingIsLost) {
  const auto expect = [&](const std::string& arguments, const std::string& part) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.lines(), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(part), std::string::npos) << outcome.errors;
  };
  const std::string config = "--config " + path("c.yaml"), out = " --out " + path("bad");
  const auto altered = [&](const std::string& name, auto change) {
    fs::remove_all(path(name));
    fs::copy(path("eq"), path(name), fs::copy_options::recursive);
    const fs::path csv = fs::path(path(name)) / "E2/muscles.csv";
    write(csv, change(content(csv)));
    return config + out + " --data " + path(name);
  };
  expect(config + out + " --data " + path("nowhere"), "no such folder of recordings");
  fs::create_directories(path("empty"));
  expect(config + out + " --data " + path("empty"), "holds no recordings");
  expect(altered("x", [](const std::string&) { return std::string(); }), "muscles.csv: empty");
  expect(altered("x", [](const std::string& text) { return text.substr(0, text.size() / 2); }),
         "muscles.csv:");
  expect(altered("x",
                 [](std::string text) {
                   const std::size_t line = text.find('\n', text.size() / 2);
                   const std::size_t cell = text.find(',', line) + 1;
                   return text.replace(cell, text.find(',', cell) - cell, "nan");
                 }),
         "expected a finite number");
  expect(altered("x",
                 [](const std::string& text) {
                   const std::size_t row = text.find('\n') + 1, next = text.find('\n', row) + 1;
                   return text + text.substr(row, next - row);
                 }),
         "expected time to grow");
  expect(
      altered("x", [](std::string text) { return text.replace(text.find("flexor"), 6, "biceps"); }),
      "no such quantity");
  expect(config + out + " --data " + path("tr"), "expected equilibria");

  write_config("impossible.yaml", "equilibria", -0.001);
  expect("--config " + path("impossible.yaml") + out + " --data " + path("eq"), "impossible.yaml:");
  write(path("unknown.yaml"), content(path("c.yaml")) + "colour: red\n");
  expect("--config " + path("unknown.yaml") + out + " --data " + path("eq"), "unknown key");
  std::string nowhere = content(path("c.yaml"));
  const std::size_t model = nowhere.find("model: ") + 7;
  write(path("nowhere.yaml"),
        nowhere.replace(model, nowhere.find('\n', model) - model, "not_there.yaml"));
  expect("--config " + path("nowhere.yaml") + out + " --data " + path("eq"),
         "model: not_there.yaml: expected a model file");
  expect(config + out + " --optimiser magic --data " + path("eq"),
         "--optimiser: magic not in {evolution_strategy,");
  std::string text = content(path("c.yaml"));
  write(path("target.yaml"), text.insert(text.find("seed: 3"), "target: 0.1, "));
  expect(
      "--config " + path("target.yaml") + out + " --optimiser least_squares --data " + path("eq"),
      "target: 0.1: expected 0");
  expect(config + out + " --resume --data " + path("eq"), "expected the journal");
  EXPECT_FALSE(fs::exists(path("bad")));  // nothing was there to resume

  fs::create_directories(path("held_out"));
  fs::copy(path("eq/E2"), path("held_out/of_them"), fs::copy_options::recursive);
  expect(config + out + " --data " + path("eq") + " --validation " + path("held_out"),
         "held_out: of_them is the same recording as E2 of " + path("eq"));
  // Whatever is said of how it begins.
  Dataset other = Dataset::load(path("eq/E2"));
  other.meta.settle_s += 1.0;
  other.save(path("held_out_2/of_them"));
  expect(config + out + " --data " + path("eq") + " --validation " + path("held_out_2"),
         "held_out_2: of_them is the same recording as E2 of " + path("eq"));
  fs::create_directories(path("doubled"));
  fs::copy(path("eq/E2"), path("doubled/E2"), fs::copy_options::recursive);
  write_bag(Dataset::load(path("eq/E2")), path("doubled/again.bag"));
  expect(config + out + " --data " + path("doubled"), "doubled/again.bag: the same recording as");
  expect(config + out + " --data " + path("doubled"), path("doubled/E2"));
  write(path("file"), "");
  const Outcome unwritable = run(config + " --out " + path("file") + "/x --data " + path("eq"));
  EXPECT_EQ(unwritable.status, 1);  // no bad input
  EXPECT_EQ(unwritable.lines(), 1) << unwritable.errors;
  EXPECT_NE(unwritable.errors.find("--out"), std::string::npos) << unwritable.errors;

  // What a link leads to may be missing: then a recording would be.
  fs::copy(path("eq"), path("linked"), fs::copy_options::recursive);
  fs::create_symlink(path("nowhere"), path("linked/E9"));
  expect(config + out + " --data " + path("linked"), "linked/E9: a link to something");
  expect(config + out + " --start " + path("eq") + " --data " + path("eq"),
         path("eq") + ": cannot be read; expected the result.json of a calibration");

  // A result of a model that means something else by a path.
  write(path("other.json"), R"({"overrides": {"muscles.flexor.path.0.point.0": 0.5},
    "given": {"muscles.flexor.path.0.point.0": 0.49}})");
  expect(config + out + " --start " + path("other.json") + " --data " + path("eq"),
         "other.json: muscles.flexor.path.0.point.0: was calibrated from 0.49");

  // A journal of other data is refused, and stays.
  ASSERT_EQ(calibrate("kept", "--generations 1").status, 0);
  const std::string journal = content(path("kept/journal.txt"));
  expect(config + " --seed 9 --resume --out " + path("kept") + " --data " + path("eq"),
         "belongs to other data");
  EXPECT_EQ(content(path("kept/journal.txt")), journal);
  EXPECT_FALSE(fs::exists(path("bad/result.json")));
}

}  // namespace
}  // namespace anthrob
