#include "experiment/chain_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "arm.h"
#include "experiment/evaluator.h"
#include "experiment/excerpt.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(ChainExperiment, DifferencesAreNoiseOnlyWhereTheModelIsRight) {
  const Arm arm;
  const Dataset data = arm.record({}, 1, 1);
  const ChainExperiment experiment(*arm.plain, data, {}, {});
  std::vector<float> differences(experiment.size());
  Starts starts;
  experiment.settle(arm.plain, starts);
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
  const ChainExperiment first(*arm.plain, arm.record({}, 1, 1), {}, {}),
      second(*arm.plain, arm.record({}, 1, 2), {}, {});
  std::vector<float> alone(second.size()), after(second.size()), ignored(first.size());
  Starts none, starts;
  second.settle(model, none);
  second.compare(model, none, alone.data());
  first.settle(model, starts);
  first.compare(model, starts, ignored.data());
  second.settle(model, starts);
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
  const ChainExperiment first(*arm.plain, arm.record({}, 1, 1), {}, {}),
      second(*arm.plain, elsewhere, {}, {});
  std::vector<float> alone(second.size()), after(second.size()), ignored(first.size());
  Starts none, starts;
  second.settle(arm.plain, none);
  second.compare(arm.plain, none, alone.data());
  first.settle(arm.plain, starts);
  first.compare(arm.plain, starts, ignored.data());
  second.settle(arm.plain, starts);
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
  for (const Dataset& data : recordings) whole.push_back(make_experiment(*arm.plain, data, {}));
  const Evaluator evaluator(ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml", {}, 0.001, 1);
  const Differences all = evaluator.compare({Variant{}}, whole).front();
  for (const double seconds : {4.0, 11.0, 1000.0}) {
    const Excerpt part = excerpt(*arm.plain, recordings, whole, seconds, {});
    EXPECT_NEAR(part.duration(), std::min(seconds, total_duration(whole)), 0.021);
    EXPECT_EQ(evaluator.compare({Variant{}}, part.experiments).front(), part.of(all)) << seconds;
  }
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
