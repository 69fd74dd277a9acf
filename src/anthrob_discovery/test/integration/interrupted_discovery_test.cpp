// Searches that are interrupted and go on.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/testing/interrupt.h"
#include "arm.h"
#include "axis_recording.h"
#include "config.h"
#include "discover.h"
#include "report/discovery_report.h"

namespace anthrob {
namespace discovery {
namespace {

namespace fs = std::filesystem;

class InterruptedRun : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  const fs::path folder_ =
      fs::temp_directory_path() / ("anthrob_discovery_" + std::to_string(getpid()));
};

TEST_F(InterruptedRun, RunGoesOnWithTheSameBitsAndSimulatesNothingTwice) {
  const Question question = axis_question(20.4, 0.0);
  const auto evaluator = [&] {
    return std::make_unique<Evaluator>(question.model_file, question.nuisances, question.step, 1);
  };
  const auto whole = evaluator();
  whole->keep_journal(path("whole.bin"), 1);
  const std::string expected = report_json(discover(*whole, question), question, 0.0);

  std::size_t simulated = 0;
  int stopped = 0;
  std::string report;
  for (const std::size_t third : {1, 2, 4}) {
    const auto part = evaluator();
    part->keep_journal(path("part.bin"), 1);
    part->on_progress([&](const Batch&) {
      return simulated + part->simulated() < third * whole->simulated() / 3;
    });
    try {
      report = report_json(discover(*part, question), question, 0.0);
    } catch (const discovery::Interrupted&) {
      ++stopped;
    }
    simulated += part->simulated();
  }
  EXPECT_EQ(stopped, 2);
  EXPECT_EQ(report, expected);
  EXPECT_EQ(simulated, whole->simulated());
}

TEST_F(InterruptedRun, OnTheArmGoesOnWithTheSameBitsOnAnotherNumberOfThreads) {
  const Arm arm;
  const std::vector<EffectInstance> hidden = {
      {"joint_coulomb", "elbow", {{"torque", 0.06}, {"static_ratio", 1.2}}}};
  Question question;
  question.model_file = kConfig + "/anthrob/model_I.yaml";
  question.nuisances = {{"joints.elbow.friction.viscous", "Nms/rad", 0.02, 0.0, 0.1, 0.01}};
  question.train = {arm.record(hidden, 1, 1)};
  question.test = {arm.record(hidden, 2, 2)};
  question.effects = {"joint_coulomb"};
  question.max_effects = 1;
  const auto evaluator = [&](int jobs) {
    return std::make_unique<Evaluator>(question.model_file, question.nuisances, question.step,
                                       jobs);
  };
  const auto whole = evaluator(1);
  const Answer expected = discover(*whole, question);
  ASSERT_EQ(expected.effects.size(), 1u);

  auto part = evaluator(2);
  part->keep_journal(path("journal.bin"), 1);
  part->on_progress([&](const Batch&) { return part->simulated() < whole->simulated() / 2; });
  EXPECT_THROW(discover(*part, question), Interrupted);
  part.reset();
  const auto rest = evaluator(2);
  rest->keep_journal(path("journal.bin"), 1);
  EXPECT_EQ(report_json(discover(*rest, question), question, 0.0),
            report_json(expected, question, 0.0));
  EXPECT_LT(rest->simulated(), 0.7 * static_cast<double>(whole->simulated()));
}

std::string content(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(InterruptedRun, ToolDoesNotReplaceTheModelThatItReads) {
  fs::create_directories(path("found"));
  const std::string text = "extends: " + kConfig + "/driven_axis/model_I.yaml\n";
  std::ofstream(path("found/model.yaml")) << text;
  axis_recording(20.4, 0.0, 1).save(path("train"));
  const std::string command = std::string(ANTHROB_DISCOVER) + " --model " +
                              path("found/model.yaml") + " --train " + path("train") + " --test " +
                              path("train") + " --out " + path("found") + " 2>" + path("errors");
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(content(path("errors")).find("model.yaml is an input of this run"), std::string::npos)
      << content(path("errors"));
  EXPECT_EQ(content(path("found/model.yaml")), text);
}

TEST_F(InterruptedRun, LoopDoesNotReplaceRecordingsThatItReads) {
  const std::string model = kConfig + "/driven_axis/model_I.yaml";
  for (const char* end : {"", "/"}) {
    axis_recording(20.4, 0.0, 1).save(path("train"));
    axis_recording(20.4, 0.0, 2).save(path("found/separating_1_test"));
    const std::string command = std::string(ANTHROB_DISCOVER) + " --model " + model + " --train " +
                                path("train") + " --test " + path("found/separating_1_test") + end +
                                " --close-the-loop " + model + " --out " + path("found") +
                                " >/dev/null 2>" + path("errors");
    const int status = std::system(command.c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 2);
    EXPECT_NE(content(path("errors")).find("separating_1_test is an input of this run"),
              std::string::npos)
        << content(path("errors"));
    EXPECT_TRUE(fs::exists(path("found/separating_1_test/meta.yaml")));
  }
}

TEST_F(InterruptedRun, ToolSaysFirstThatItCannotWrite) {
  const std::string command =
      std::string(ANTHROB_DISCOVER) + " --model " + kConfig +
      "/driven_axis/model_I.yaml --train x --test y --out /proc/nowhere 2>" + path("errors");
  const int status = std::system(command.c_str());
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(content(path("errors")).find("--out /proc/nowhere"), std::string::npos);
}

TEST_F(InterruptedRun, ToolSaysHowToGoOn) {
  axis_recording(20.4, 0.0, 1).save(path("train"));
  axis_recording(20.4, 0.0, 2).save(path("test"));
  const auto run = [&](const std::string& before, const std::string& out) {
    const int status = std::system((before + ANTHROB_DISCOVER + " --model " + kConfig +
                                    "/driven_axis/model_I.yaml --train " + path("train") +
                                    " --test " + path("test") + " --jobs 1 --out " + path(out) +
                                    " __name:=discover >/dev/null 2>" + path("errors"))
                                       .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const auto report = [&](const std::string& out) {
    auto json = nlohmann::json::parse(content(path(out + "/report.json")));
    json.erase("runtime_s");
    return json;
  };
  ASSERT_EQ(run("", "whole"), 0) << content(path("errors"));
  EXPECT_FALSE(fs::exists(path("whole/journal.bin")));
  const auto question = report("whole")["question"];
  EXPECT_EQ(question["calibration"], kConfig + "/driven_axis/calibration.yaml");
  EXPECT_EQ(question["fingerprints"]["model"],
            resume::fingerprint_text(resume::model_fingerprint(
                ConfigNode::load(kConfig + "/driven_axis/model_I.yaml"))));
  EXPECT_NE(question["fingerprints"]["train"], question["fingerprints"]["test"]);
  const std::string script = path("interrupt.sh");
  const int status = run(interrupted_when(path("stopped/journal.bin"), script), "stopped");
  ASSERT_TRUE(interrupt_was_sent(script)) << "finished too early: make the work longer";
  ASSERT_EQ(status, 130) << content(path("errors"));
  EXPECT_NE(content(path("errors")).find("run the same command again to continue"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(path("stopped/journal.bin")));
  EXPECT_FALSE(fs::exists(path("stopped/report.json")));
  ASSERT_EQ(run("", "stopped"), 0);
  EXPECT_NE(content(path("errors")).find("simulations of an interrupted run"), std::string::npos);
  EXPECT_FALSE(fs::exists(path("stopped/journal.bin")));
  EXPECT_EQ(report("stopped"), report("whole"));

  if (std::system("mpirun --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no mpirun";
  const std::string mpirun =
      "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timeout 300 mpirun "
      "--oversubscribe -n 3 ";
  ASSERT_EQ(run(mpirun, "hosts"), 0) << content(path("errors"));
  EXPECT_EQ(report("hosts"), report("whole"));
  fs::remove(script);
  run("env " + mpirun + interrupted_when(path("left/journal.bin"), script), "left");
  ASSERT_TRUE(fs::exists(path("left/journal.bin"))) << content(path("errors"));
  // What MPI loads is no other build.
  ASSERT_EQ(run("", "left"), 0);
  EXPECT_NE(content(path("errors")).find("simulations of an interrupted run"), std::string::npos)
      << content(path("errors"));
  EXPECT_EQ(report("left"), report("whole"));
}

TEST_F(InterruptedRun, OfAnotherEffectLibraryIsBegunAnew) {
  axis_recording(20.4, 0.0, 1).save(path("train"));
  axis_recording(20.4, 0.0, 2).save(path("test"));
  fs::copy_file(ANTHROB_OTHER_LIBRARY, path("libown.so"));
  std::ofstream(path("own.yaml")) << "extends: " << kConfig << "/driven_axis/model_I.yaml\n"
                                  << "effect_libraries: [own]\n";
  const auto run = [&](const std::string& before) {
    const int status = std::system(
        ("LD_LIBRARY_PATH=" + folder_.string() + ":$LD_LIBRARY_PATH ANTHROB_EFFECT_LIBRARIES=own " +
         before + ANTHROB_DISCOVER + " --model " + path("own.yaml") + " --train " + path("train") +
         " --test " + path("test") + " --jobs 1 --out " + path("found") + " >/dev/null 2>" +
         path("errors"))
            .c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  };
  const std::string script = path("interrupt.sh");
  const int status = run(interrupted_when(path("found/journal.bin"), script));
  ASSERT_TRUE(interrupt_was_sent(script)) << "finished too early: make the work longer";
  ASSERT_EQ(status, 130) << content(path("errors"));
  std::ofstream(path("libown.so"), std::ios::app) << "x";  // the linker's mark stays
  ASSERT_EQ(run(""), 0) << content(path("errors"));
  EXPECT_NE(content(path("errors")).find("everything is simulated again"), std::string::npos)
      << content(path("errors"));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
