#include "anthrob_calib/discovery/discovery.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Cholesky>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "anthrob_calib/discovery/experiment/axis_experiment.h"
#include "anthrob_calib/discovery/experiment/chain_experiment.h"
#include "anthrob_calib/discovery/experiment/excerpt.h"
#include "anthrob_calib/discovery/fit/candidate.h"
#include "anthrob_calib/discovery/fit/model_fit.h"
#include "anthrob_calib/discovery/judgement/judge.h"
#include "anthrob_calib/discovery/model_text.h"
#include "anthrob_calib/discovery/number_text.h"
#include "anthrob_calib/discovery/search/preparation.h"
#include "anthrob_calib/report/discovery_report.h"
#include "anthrob_calib/report/discovery_summary.h"
#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/effects/catalogue.h"
#include "arm.h"
#include "axis_recording.h"
#include "interrupt.h"

namespace anthrob {
namespace discovery {
namespace {

namespace fs = std::filesystem;

const std::string kConfig = ANTHROB_CONFIG_DIR;

// ---- tools ------------------------------------------------------------------------------------

TEST(BoundedMinimum, IsTheFreeOneInsideAndSatisfiesOptimalityAtBounds) {
  const CounterRandom random(3, 1);
  std::uint64_t n = 0;
  for (int round = 0; round < 50; ++round) {
    Eigen::MatrixXd root(6, 6);
    Eigen::VectorXd g(6);
    for (int i = 0; i < 6; ++i) {
      g[i] = random.normal(n++);
      for (int j = 0; j < 6; ++j) root(i, j) = random.normal(n++);
    }
    const Eigen::MatrixXd A = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(6, 6);
    const Eigen::VectorXd wide = Eigen::VectorXd::Constant(6, 1e6);
    EXPECT_LT((bounded_minimum(A, g, -wide, wide) + A.ldlt().solve(g)).norm(), 1e-8);
    const Eigen::VectorXd lower = Eigen::VectorXd::Constant(6, -0.2), upper = -0.5 * lower;
    const Eigen::VectorXd x = bounded_minimum(A, g, lower, upper), gradient = A * x + g;
    for (int i = 0; i < 6; ++i) {
      EXPECT_GE(x[i], lower[i]);
      EXPECT_LE(x[i], upper[i]);
      if (x[i] == lower[i]) {
        EXPECT_GE(gradient[i], -1e-7);
      } else if (x[i] == upper[i]) {
        EXPECT_LE(gradient[i], 1e-7);
      } else {
        EXPECT_NEAR(gradient[i], 0.0, 1e-7);
      }
    }
  }
}

TEST(CorrelationLength, OfWhiteAndOfColouredNoise) {
  const CounterRandom random(5, 1);
  Eigen::VectorXf white(4000), coloured(4000);
  float memory = 0.0f;
  for (int i = 0; i < 4000; ++i) {
    white[i] = static_cast<float>(random.normal(static_cast<std::uint64_t>(i)));
    memory = 0.9f * memory + white[i];
    coloured[i] = memory;
  }
  EXPECT_NEAR(correlation_length(white), 1.0, 0.2);
  EXPECT_NEAR(correlation_length(coloured), 19.0, 5.0);  // (1 + a) / (1 - a)
}

TEST(ModelProbabilities, FollowTheScoresAndTheHandicap) {
  Eigen::MatrixXd scores = Eigen::MatrixXd::Zero(3, 20);
  scores.row(1).setConstant(1.0);
  scores.row(2).setConstant(1.0);
  const auto even = model_probabilities(scores, {0.0, 0.0, 0.0}, 1);
  EXPECT_LT(even[0], 1e-6);
  EXPECT_NEAR(even[1], 0.5, 1e-9);
  const auto handicapped = model_probabilities(scores, {0.0, 0.0, 30.0}, 1);
  EXPECT_GT(handicapped[1], 0.999);
  const auto all = model_probabilities(scores, {0.0, 60.0, 60.0}, 1);
  EXPECT_GT(all[0], 0.999);
}

TEST(BlockSignificance, DoesNotDoubtGainsThatDifferInSize) {
  Eigen::VectorXd large(8), noise(200);
  large << 3.0, 2000.0, 40.0, 15.0, 9000.0, 120.0, 7.0, 300.0;
  EXPECT_GT(block_significance(large), 5.0);
  const CounterRandom random(9, 1);
  for (int i = 0; i < 200; ++i) noise[i] = 50.0 * random.normal(static_cast<std::uint64_t>(i));
  EXPECT_LT(std::abs(block_significance(noise)), 2.5);
  noise[17] = 1e6;  // one lucky block
  EXPECT_LT(block_significance(noise), 2.5);
}

TEST(BlockSignificance, DoesNotDoubtGainsForSmallLossesBesideThem) {
  Eigen::VectorXd gains(24);
  for (int i = 0; i < 24; ++i) gains[i] = i % 2 == 0 ? 45.0 + i : -4.0;
  EXPECT_GT(block_significance(gains), 4.0);
  EXPECT_LT(block_significance(-gains), -1.0);
  for (int i = 0; i < 24; ++i) gains[i] = i % 2 == 0 ? 45.0 : -44.0;
  EXPECT_LT(block_significance(gains), 1.0);
}

// ---- a driven axis, made here by its closed equation
// -----------------------------------------------

const FoundParameter* find_parameter(const FoundEffect& effect, const std::string& name) {
  const auto found = std::find_if(effect.parameters.begin(), effect.parameters.end(),
                                  [&](const FoundParameter& p) { return p.name == name; });
  return found == effect.parameters.end() ? nullptr : &*found;
}

Answer ask(const Question& question, int jobs = 2) {
  const Evaluator evaluator(question.model_file, question.nuisances, question.step, jobs);
  return discover(evaluator, question);
}

TEST(DrivenAxis, DryFrictionIsNamedAndMeasured) {
  const Answer answer = ask(axis_question(20.4, 0.0));
  ASSERT_EQ(answer.verdict, "effects_found") << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_EQ(answer.effects[0].place, "axis");
  for (const FoundParameter& p : answer.effects[0].parameters) {
    EXPECT_LE(p.low, p.value) << p.name;
    EXPECT_GE(p.high, p.value) << p.name;
  }
  const FoundParameter* torque = find_parameter(answer.effects[0], "torque");
  ASSERT_NE(torque, nullptr);
  EXPECT_NEAR(torque->value, 20.4, 0.6);
  EXPECT_LT(answer.test.after, 0.3 * answer.test.recalibrated);
}

TEST(DrivenAxis, OffsetAndAsymmetricFrictionAreSaidToBeAlike) {
  const Answer answer = ask(axis_question(20.4, -3.2));
  ASSERT_GE(answer.effects.size(), 2u) << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  std::set<std::string> second = {answer.effects[1].id};
  for (const Rival& rival : answer.effects[1].rivals) second.insert(rival.id);
  EXPECT_TRUE(second.count("joint_offset_torque")) << summary(answer);
  EXPECT_TRUE(second.count("joint_coulomb_asymmetric")) << summary(answer);
  EXPECT_NE(answer.effects[1].separating_experiment.find("drive off"), std::string::npos);
  // They show in the same, and leave the same of what was there at first.
  EXPECT_EQ(answer.effects[1].shows_in, "axis/effort");
  EXPECT_LT(answer.effects[1].left, 0.05);
  EXPECT_EQ(answer.effects[1].left, answer.effects[0].left);
  // One law says what the two say.
  ASSERT_EQ(answer.alternatives.size(), 1u) << summary(answer);
  const Alternative& one = answer.alternatives[0];
  EXPECT_EQ(one.id, "joint_coulomb_asymmetric");
  EXPECT_EQ(one.instead_of[0], 0u);
  EXPECT_EQ(one.instead_of[1], 1u);
  EXPECT_GT(one.probability, 0.05);
  EXPECT_LT(one.probability, 0.95);
  EXPECT_NE(one.separating_experiment.find("drive off"), std::string::npos);
}

TEST(DrivenAxis, ALawThatSaysMoreIsNamedWhereTheSearchEndsWithASimplerOne) {
  Question question = axis_question(20.4, -3.2);
  question.max_effects = 1;
  const Answer answer = ask(question);
  ASSERT_EQ(answer.effects.size(), 1u) << summary(answer);
  const FoundEffect& effect = answer.effects[0];
  ASSERT_EQ(effect.id, "joint_coulomb_asymmetric") << summary(answer);
  EXPECT_GT(effect.probability, 0.5) << summary(answer);
  const FoundParameter *forward = find_parameter(effect, "forward"),
                       *backward = find_parameter(effect, "backward");
  ASSERT_TRUE(forward && backward);
  EXPECT_NEAR(forward->value, 20.4 - 3.2, 0.8);
  EXPECT_NEAR(backward->value, 20.4 + 3.2, 0.8);
}

TEST(DrivenAxis, WhatLeavesNearlyAllOfTheGapDoesNotExtendTheModel) {
  Question question = axis_question(20.4, 0.0);
  question.effects = {"payload"};  // gains, for friction also resists motion
  const Answer answer = ask(question);
  EXPECT_EQ(answer.verdict, "unexplained") << summary(answer);
  EXPECT_TRUE(answer.effects.empty()) << summary(answer);
  ASSERT_EQ(answer.improbable.size(), 1u) << summary(answer);
  EXPECT_EQ(answer.improbable[0].id, "payload");
  EXPECT_EQ(answer.improbable[0].shows_in, "axis/effort");
  EXPECT_GT(answer.improbable[0].left, 0.5);
  EXPECT_LT(answer.improbable[0].probability, 0.1);
  EXPECT_TRUE(answer.extended.effects.empty());
  EXPECT_EQ(answer.test.after, answer.test.recalibrated);
  EXPECT_EQ(answer.extended.nuisances, answer.recalibrated.nuisances);
  // But where the search had no room for what else may be missing, it stays.
  question.max_effects = 1;
  const Answer capped = ask(question);
  ASSERT_EQ(capped.effects.size(), 1u) << summary(capped);
  EXPECT_LT(capped.effects[0].probability, 0.1);
  // Where the mass sits makes no difference to an axis that does not turn.
  const FoundParameter *mass = find_parameter(capped.effects[0], "mass"),
                       *x = find_parameter(capped.effects[0], "x");
  ASSERT_TRUE(mass && x);
  EXPECT_TRUE(mass->has_interval()) << summary(capped);
  EXPECT_TRUE(x->undetermined) << summary(capped);
}

TEST(DrivenAxis, NothingIsNamedWhereNothingIsMissing) {
  const Answer answer = ask(axis_question(0.0, 0.0));
  EXPECT_EQ(answer.verdict, "no_missing_effect") << summary(answer);
  EXPECT_TRUE(answer.effects.empty()) << summary(answer);
}

TEST(DrivenAxis, WhatIsNamedIsLargerThanWhatIsSaidToShow) {
  const Answer nothing = ask(axis_question(0.0, 0.0));
  const auto friction = std::find_if(nothing.visible.begin(), nothing.visible.end(),
                                     [](const Visibility& v) { return v.id == "joint_coulomb"; });
  ASSERT_NE(friction, nothing.visible.end());
  const double smallest = friction->smallest_visible;
  const Answer less = ask(axis_question(0.6 * smallest, 0.0));
  EXPECT_EQ(less.verdict, "no_missing_effect") << smallest << "\n" << summary(less);
  const Answer more = ask(axis_question(1.6 * smallest, 0.0));
  ASSERT_EQ(more.verdict, "effects_found") << smallest << "\n" << summary(more);
  EXPECT_EQ(more.effects[0].id, "joint_coulomb") << summary(more);
}

TEST(DrivenAxis, WhatIsSaidToShowMostlyDoes) {
  int found = 0, told = 0;
  for (std::uint64_t seed = 10; seed < 40; ++seed) {
    const auto with = [&](double coulomb) {
      Question question = axis_question(coulomb, 0.0);
      question.train = {axis_recording(coulomb, 0.0, seed)};
      question.test = {axis_recording(coulomb, 0.0, seed + 100)};
      return ask(question);
    };
    for (const Visibility& shows : with(0.0).visible) {
      if (shows.id != "joint_coulomb") continue;
      ++told;
      const Answer answer = with(shows.smallest_visible);
      found += !answer.effects.empty() && answer.effects[0].id == "joint_coulomb";
    }
  }
  EXPECT_EQ(told, 30);
  EXPECT_GE(found, 21);  // said are 19 of 20; what noise does to the fit is left out
}

TEST(DrivenAxis, WhatACalibrationMayTakeUpIsNotSaidToShow) {
  Question question = axis_question(0.0, 0.0);
  ASSERT_EQ(question.nuisances.size(), 1u);
  const ModelParameter& viscous = question.nuisances.front();
  const double room = viscous.upper - viscous.initial;
  for (const std::uint64_t seed : {1u, 3u, 5u}) {
    question.train = {axis_recording(0.0, 0.0, seed)};
    const Answer answer = ask(question);
    const auto found = std::find_if(answer.visible.begin(), answer.visible.end(),
                                    [](const Visibility& v) { return v.id == "joint_viscous"; });
    ASSERT_NE(found, answer.visible.end()) << seed;
    EXPECT_GT(found->smallest_visible, room) << seed;
    EXPECT_LT(found->smallest_visible, 1.1 * room) << seed;
  }
}

TEST(DrivenAxis, SameBitsOnAnyNumberOfThreads) {
  const Question question = axis_question(20.4, 0.0);
  const std::string one = report_json(ask(question, 1), question, 0.0);
  EXPECT_EQ(one, report_json(ask(question, 2), question, 0.0));
}

// ---- interrupted runs
// -------------------------------------------------------------------------------------------------

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
  whole->keep_journal(path("whole.bin"));
  const std::string expected = report_json(discover(*whole, question), question, 0.0);

  std::size_t simulated = 0;
  int stopped = 0;
  std::string report;
  for (const std::size_t third : {1, 2, 4}) {
    const auto part = evaluator();
    part->keep_journal(path("part.bin"));
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
}

TEST_F(InterruptedRun, OfAnotherEffectLibraryIsBegunAnew) {
  axis_recording(20.4, 0.0, 1).save(path("train"));
  axis_recording(20.4, 0.0, 2).save(path("test"));
  fs::copy_file(ANTHROB_OTHER_LIBRARY, path("libown.so"));
  std::ofstream(path("own.yaml")) << "extends: " << kConfig << "/driven_axis/model_I.yaml\n"
                                  << "effect_libraries: [own]\n";
  const auto run = [&](const std::string& before) {
    const int status = std::system(
        ("LD_LIBRARY_PATH=" + folder_.string() + ":$LD_LIBRARY_PATH " + before + ANTHROB_DISCOVER +
         " --model " + path("own.yaml") + " --train " + path("train") + " --test " + path("test") +
         " --jobs 1 --out " + path("found") + " >/dev/null 2>" + path("errors"))
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

// ---- the arm
// --------------------------------------------------------------------------------------

TEST(ChainExperiment, DifferencesAreNoiseOnlyWhereTheModelIsRight) {
  const Arm arm;
  const Dataset data = arm.record({}, 1, 1);
  const ChainExperiment experiment(*arm.plain, data, {});
  std::vector<float> differences(experiment.size());
  Starts starts;
  experiment.compare(arm.plain, starts, differences.data());
  const MadeRecording made;
  for (const Channel& channel : experiment.channels()) {
    double square = 0.0;
    for (std::size_t b = 0; b < channel.count; ++b) {
      square += std::pow(differences[channel.offset + b], 2);
    }
    const double rms = std::sqrt(square / static_cast<double>(channel.count));
    const double noise = channel.quantity == "force"      ? made.force_noise
                         : channel.quantity == "current"  ? made.current_noise
                         : channel.quantity == "voltage"  ? made.voltage_noise
                         : channel.quantity == "position" ? made.position_noise
                                                          : made.joint_noise;
    // Four samples a bin.
    EXPECT_NEAR(rms, 0.5 * noise, 0.1 * noise) << channel.name();
  }
}

TEST(ChainExperiment, RecordingsThatStartAlikeSettleOnce) {
  const Arm arm;
  LoadOptions options;
  options.effects = {
      {"see_hysteresis", "biceps_brachii", {{"share", 0.1}}},
      {"winding_heating", "teres_major", {{"thermal_resistance", 20.0}}}};  // they remember
  const auto model = build_robot_model(arm.config, options);
  const ChainExperiment first(*arm.plain, arm.record({}, 1, 1), {}),
      second(*arm.plain, arm.record({}, 1, 2), {});
  std::vector<float> alone(second.size()), after(second.size()), ignored(first.size());
  Starts none, starts;
  second.compare(model, none, alone.data());
  first.compare(model, starts, ignored.data());
  second.compare(model, starts, after.data());
  EXPECT_EQ(starts.size(), 1u);
  EXPECT_EQ(after, alone);  // to the last bit
}

TEST(ChainExperiment, RecordingsThatSettleAlikeMayStandElsewhere) {
  const Arm arm;
  Dataset elsewhere = arm.record({}, 1, 2);
  constexpr double kOff = 0.05;  // [rad]
  for (Column& column : elsewhere.table("muscles").columns) {
    if (column.name != "biceps_brachii/position") continue;
    for (double& value : column.values) value += kOff;
  }
  const ChainExperiment first(*arm.plain, arm.record({}, 1, 1), {}),
      second(*arm.plain, elsewhere, {});
  std::vector<float> alone(second.size()), after(second.size()), ignored(first.size());
  Starts none, starts;
  second.compare(arm.plain, none, alone.data());
  first.compare(arm.plain, starts, ignored.data());
  second.compare(arm.plain, starts, after.data());
  EXPECT_EQ(starts.size(), 1u);
  EXPECT_EQ(after, alone);
  for (const Channel& channel : second.channels()) {
    if (channel.name() != "biceps_brachii/position") continue;
    EXPECT_LT(std::abs(after[channel.offset]), 0.5 * kOff);  // there at first, and led back then
    EXPECT_NEAR(after[channel.offset + channel.count - 1], -kOff, 0.1 * kOff);
  }
}

TEST(Excerpt, IsTheBeginningOfTheWhole) {
  const Arm arm;
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1), arm.record({}, 2, 2)};
  Experiments whole;
  for (const Dataset& data : recordings) whole.push_back(make_experiment(*arm.plain, data));
  const Evaluator evaluator(kConfig + "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Differences all = evaluator.compare({Variant{}}, whole).front();
  for (const double seconds : {4.0, 11.0, 1000.0}) {
    const Excerpt part = excerpt(*arm.plain, recordings, whole, seconds);
    EXPECT_NEAR(part.duration(), std::min(seconds, total_duration(whole)), 0.021);
    EXPECT_EQ(evaluator.compare({Variant{}}, part.experiments).front(), part.of(all)) << seconds;
  }
}

TEST(ModelFit, CoarseStepsTellTheSameChanges) {
  const Arm arm;
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1)};
  const Experiments train = {make_experiment(*arm.plain, recordings.front())};
  const Evaluator evaluator(kConfig + "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Scales scales = measure_scales(evaluator, train, {});
  const Eigen::VectorXf factors = whitener(train, scales, false);
  const ModelFit fine(evaluator, train, factors);
  const Variant base{};
  const Eigen::VectorXf residual = fine.residual(base);
  const struct {
    LongerStep longer;
    float scaled, otherwise;  // shares of the change by which it may be off
  } steps[] = {{{2.0, 3.0}, 0.03f, 0.2f}, {{4.0, 20.0}, 0.2f, 0.6f}};
  for (const auto& [longer, scaled, otherwise] : steps) {
    const double step = coarse_step(evaluator, train, scales, longer);
    EXPECT_EQ(step, 0.001 * longer.times);
    const ModelFit coarse(evaluator, train, factors, step);
    for (const EffectInstance& effect :
         {EffectInstance{"joint_viscous", "elbow", {{"damping", 0.02}}},
          EffectInstance{"force_sensor_offset", "brachialis", {{"offset", 1.0}}},
          EffectInstance{"series_resistance", "teres_major", {{"resistance", 1.0}}}}) {
      Variant moved = base;
      moved.effects = {effect};
      const Eigen::VectorXf exact = fine.changes(base, residual, {moved}).front();
      const Eigen::VectorXf quick = coarse.changes(base, residual, {moved}).front();
      ASSERT_GT(exact.norm(), 0.0f) << effect.id;
      // Alike in size; edges of voltages and currents come a few milliseconds later.
      EXPECT_NEAR(quick.dot(exact), exact.squaredNorm(), scaled * exact.squaredNorm())
          << effect.id << " " << step;
      EXPECT_LT((quick - exact).norm(), otherwise * exact.norm()) << effect.id << " " << step;
      EXPECT_EQ(exact, fine.residual(moved) - residual) << effect.id;
    }
  }
}

TEST(CoarseStep, IsNotUsedWhereItsErrorIsLarger) {
  const Arm arm;
  const std::vector<Dataset> recordings = {arm.record({}, 1, 1)};
  const Experiments train = {make_experiment(*arm.plain, recordings.front())};
  const Evaluator evaluator(kConfig + "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Scales scales = measure_scales(evaluator, train, {});
  EXPECT_EQ(coarse_step(evaluator, train, scales, {4.0, 1e3}), 0.004);
  EXPECT_EQ(coarse_step(evaluator, train, scales, {4.0, 1e-3}), 0.0);
}

TEST(ListCandidates, EveryDoseCanBeBuilt) {
  const std::string model = kConfig + "/anthrob/model_I.yaml";
  const Evaluator evaluator(model, ordinary_parameters(model, ""), 0.001, 1);
  const std::vector<Candidate> candidates = list_candidates(evaluator, {});
  EXPECT_GT(candidates.size(), 100u);
  for (const Candidate& candidate : candidates) {
    EXPECT_FALSE(candidate.sizes().empty()) << candidate.name();
    for (const EffectParameter* size : candidate.sizes()) {
      Variant variant{evaluator.initial_nuisances()};
      variant.effects = {candidate.dose(*size)};
      EXPECT_NO_THROW(evaluator.build(variant)) << candidate.name() << " " << size->name;
    }
  }
}

TEST(ListCandidates, EffectsThatAreAskedForHaveAPlace) {
  const std::string model = kConfig + "/driven_axis/model_I.yaml";
  const Evaluator evaluator(model, {}, 0.001, 1);
  EXPECT_FALSE(list_candidates(evaluator, {"joint_coulomb"}).empty());
  try {
    list_candidates(evaluator, {"joint_coulomb", "cogging"});
    FAIL() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("--effects cogging: "), std::string::npos)
        << error.what();
  }
}

TEST(Arm, FrictionOfTheElbowIsNamedAmongOtherEffects) {
  const Arm arm;
  const std::vector<EffectInstance> hidden = {
      {"joint_coulomb", "elbow", {{"torque", 0.06}, {"static_ratio", 1.2}}}};
  Question question;
  question.model_file = kConfig + "/anthrob/model_I.yaml";
  question.train = {arm.record(hidden, 1, 1)};
  question.test = {arm.record(hidden, 2, 2)};
  question.repeats = {arm.record(hidden, 1, 3)};
  question.effects = {"joint_coulomb", "cable_drag", "payload", "gravity_tilt",
                      "ball_joint_load_friction"};
  question.max_effects = 1;
  const Answer answer = ask(question);
  ASSERT_EQ(answer.verdict, "effects_found") << summary(answer);
  EXPECT_EQ(answer.effects[0].id, "joint_coulomb") << summary(answer);
  EXPECT_EQ(answer.effects[0].place, "elbow");
  // A fit along stick and slip ends above what little noise there is here: that lowers it.
  EXPECT_GT(answer.effects[0].probability, 0.3) << summary(answer);
  EXPECT_TRUE(answer.effects[0].rivals.empty()) << summary(answer);
  EXPECT_TRUE(answer.per_channel.count(answer.effects[0].shows_in)) << answer.effects[0].shows_in;
  EXPECT_LT(answer.effects[0].left, 0.1) << summary(answer);
  EXPECT_LT(answer.test.after, 0.2 * answer.test.recalibrated) << summary(answer);
  const FoundParameter* torque = find_parameter(answer.effects[0], "torque");
  ASSERT_NE(torque, nullptr);
  EXPECT_NEAR(torque->value, 0.06, 0.006);
  EXPECT_LT(torque->low, torque->value);
  EXPECT_GT(torque->high, torque->value);
  // The model that was written loads and has the effect.
  const Evaluator evaluator(question.model_file, {}, 0.001, 1);
  const std::string text = model_text(answer, evaluator, question, kConfig + "/anthrob");
  EXPECT_NE(text.find("extends: model_I.yaml"), std::string::npos) << text;
  EXPECT_NE(text.find("joint_coulomb"), std::string::npos);
  const std::string page = report_html(answer, question, 1.0);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
