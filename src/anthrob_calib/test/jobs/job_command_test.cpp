// The command line of a goal, and goals that are refused.
#include "jobs/job_command.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace jobs {
namespace job_command_test {

CalibrateOrder calibration() {
  CalibrateOrder order;
  order.config = "/robot/statics.yaml";
  order.data = "/robot/my runs";
  order.out = "/nowhere/fit";
  return order;
}

DiscoverOrder discovery() {
  DiscoverOrder order;
  order.model = "driven_axis/I";
  order.train = {"/runs/1", "/runs/2"};
  order.test = {"/runs/3"};
  order.out = "/nowhere/found";
  return order;
}

template <class Order>
std::string line_of(const Order& order) {
  return joined(command_of(order).arguments, " ");
}

template <class Order>
std::string complaint(Order order, const std::function<void(Order&)>& spoil) {
  spoil(order);
  try {
    return line_of(order);
  } catch (const BadInput& error) {
    return error.what();
  }
}

TEST(JobCommand, IsWhatOneWouldType) {
  CalibrateOrder order = calibration();
  EXPECT_EQ(line_of(order),
            "--config /robot/statics.yaml --data /robot/my runs --out /nowhere/fit");
  EXPECT_EQ(command_of(order).arguments[3], "/robot/my runs");
  order.validation = "/robot/held";
  order.model = "anthrob/II";
  order.jobs = 2;
  order.seed = 7;
  order.options = {"--brief"};
  EXPECT_EQ(line_of(order),
            "--config /robot/statics.yaml --data /robot/my runs --validation /robot/held --model "
            "anthrob/II --out /nowhere/fit --jobs 2 --seed 7 --brief");
  DiscoverOrder search = discovery();
  search.repeat = {"/runs/4"};
  search.calibration = "/robot/calibration.yaml";
  search.options = {"--effects", "joint_coulomb"};
  EXPECT_EQ(line_of(search),
            "--model driven_axis/I --calibration /robot/calibration.yaml --train /runs/1 /runs/2 "
            "--test /runs/3 --repeat /runs/4 --out /nowhere/found --effects joint_coulomb");
}

TEST(JobCommand, OfAPipelineHasNothingBesideIt) {
  CalibrateOrder order;
  order.pipeline = "/robot/pipeline.yaml";
  order.out = "/nowhere/fit";
  order.seed = 3;
  EXPECT_EQ(command_of(order).program, "anthrob_calibrate_pipeline");
  EXPECT_EQ(line_of(order), "--pipeline /robot/pipeline.yaml --out /nowhere/fit --seed 3");
  const auto refused = [&](const std::function<void(CalibrateOrder&)>& spoil) {
    return complaint<CalibrateOrder>(order, spoil);
  };
  EXPECT_EQ(refused([](auto& o) { o.data = "/runs"; }),
            "data: /runs: expected in the file of the pipeline");
  EXPECT_EQ(refused([](auto& o) { o.options = {"--brief"}; }),
            "options: --brief: expected in the file of the pipeline");
  EXPECT_EQ(refused([](auto& o) { o.out.clear(); }),
            "out: missing; expected a folder for the result");
  EXPECT_EQ(refused([](auto& o) { o.pipeline = "p.yaml"; }),
            "pipeline: p.yaml: expected a whole path, such as /home/me/p.yaml");
}

TEST(JobCommand, ContinuesWhatWasInterrupted) {
  namespace fs = std::filesystem;
  const fs::path out = fs::temp_directory_path() / ("anthrob_goal_" + std::to_string(getpid()));
  fs::create_directories(out);
  CalibrateOrder order = calibration();
  order.out = out.string();
  EXPECT_EQ(command_of(order).arguments.back(), out.string());
  std::ofstream(out / "journal.txt") << "journal\n";
  EXPECT_EQ(command_of(order).arguments.back(), "--resume");
  order.options = {"--evaluate"};  // is no search: the program says what it thinks of this folder
  EXPECT_EQ(command_of(order).arguments.back(), "--evaluate");
  fs::remove_all(out);
}

TEST(JobCommand, RefusesGoalsOfCalibrationInOneLine) {
  const auto refused = [](const std::function<void(CalibrateOrder&)>& spoil) {
    return complaint<CalibrateOrder>(calibration(), spoil);
  };
  EXPECT_EQ(refused([](auto& o) { o.config.clear(); }),
            "config: missing; expected a configuration of the calibration");
  EXPECT_EQ(refused([](auto& o) { o.data.clear(); }),
            "data: missing; expected a folder of recordings to fit");
  EXPECT_EQ(refused([](auto& o) { o.out.clear(); }),
            "out: missing; expected a folder for the result");
  EXPECT_EQ(refused([](auto& o) { o.out = "fit"; }),
            "out: fit: expected a whole path, such as /home/me/fit");
  EXPECT_EQ(refused([](auto& o) { o.model = "mine.yaml"; }),
            "model: mine.yaml: expected a whole path, such as /home/me/mine.yaml");
  EXPECT_EQ(refused([](auto& o) { o.jobs = -1; }),
            "jobs: -1: expected a whole number from 1, or 0 for the program's own");
  EXPECT_EQ(refused([](auto& o) { o.options = {"--seed=3"}; }),
            "options: --seed: expected in the field seed");
  EXPECT_EQ(refused([](auto& o) { o.options = {"--resume"}; }),
            "options: --resume: expected without; the same goal continues by itself");
}

TEST(JobCommand, RefusesGoalsOfDiscoveryInOneLine) {
  const auto refused = [](const std::function<void(DiscoverOrder&)>& spoil) {
    return complaint<DiscoverOrder>(discovery(), spoil);
  };
  EXPECT_EQ(refused([](auto& o) { o.model.clear(); }),
            "model: missing; expected a model to examine");
  EXPECT_EQ(refused([](auto& o) { o.train.clear(); }),
            "train: missing; expected recordings that are fitted");
  EXPECT_EQ(refused([](auto& o) { o.test.clear(); }),
            "test: missing; expected held-out recordings");
  EXPECT_EQ(refused([](auto& o) { o.test = {"/runs/1"}; }),
            "test: /runs/1: is also in train; expected recordings that are not");
  EXPECT_EQ(refused([](auto& o) {
              o.train = {"/runs/1", ""};
            }),
            "train: missing; expected the path of a recording instead of an empty one");
  EXPECT_EQ(refused([](auto& o) { o.repeat = {"run"}; }),
            "repeat: run: expected a whole path, such as /home/me/run");
  EXPECT_EQ(refused([](auto& o) { o.options = {"--train"}; }),
            "options: --train: expected in the field train");
}

}  // namespace job_command_test
}  // namespace jobs
}  // namespace anthrob
