#include "judgement/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "anthrob_core/random.h"
#include "judgement/one_sided_gaps.h"

namespace anthrob {
namespace discovery {
namespace {

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
  const auto even = model_probabilities(scores, {0.0, 0.0, 0.0}, 1, {});
  EXPECT_LT(even[0], 1e-6);
  EXPECT_NEAR(even[1], 0.5, 1e-9);
  const auto handicapped = model_probabilities(scores, {0.0, 0.0, 30.0}, 1, {});
  EXPECT_GT(handicapped[1], 0.999);
  const auto all = model_probabilities(scores, {0.0, 60.0, 60.0}, 1, {});
  EXPECT_GT(all[0], 0.999);
}

TEST(BlockSignificance, DoesNotDoubtGainsThatDifferInSize) {
  Eigen::VectorXd large(8), noise(200);
  large << 3.0, 2000.0, 40.0, 15.0, 9000.0, 120.0, 7.0, 300.0;
  EXPECT_GT(block_significance(large, {}), 5.0);
  const CounterRandom random(9, 1);
  for (int i = 0; i < 200; ++i) noise[i] = 50.0 * random.normal(static_cast<std::uint64_t>(i));
  EXPECT_LT(std::abs(block_significance(noise, {})), 2.5);
  noise[17] = 1e6;  // one lucky block
  EXPECT_LT(block_significance(noise, {}), 2.5);
}

TEST(BlockSignificance, DoesNotDoubtGainsForSmallLossesBesideThem) {
  Eigen::VectorXd gains(24);
  for (int i = 0; i < 24; ++i) gains[i] = i % 2 == 0 ? 45.0 + i : -4.0;
  EXPECT_GT(block_significance(gains, {}), 4.0);
  EXPECT_LT(block_significance(-gains, {}), -1.0);
  for (int i = 0; i < 24; ++i) gains[i] = i % 2 == 0 ? 45.0 : -44.0;
  EXPECT_LT(block_significance(gains, {}), 1.0);
}

/// Measured in 20 s, of which residuals are made up.
class Effort final : public Experiment {
 public:
  Effort() {
    channels_.push_back({"axis", "effort", "N", 0, 0, 800});
    present_.assign(800, 1);
    bin_ = 0.025;
    duration_ = 20.0;
  }
  void compare(const std::shared_ptr<const RobotModel>&, const Starts&, float*) const override {}
};

TEST(OneSidedGaps, AreCertainOnOneSideAndNotThereOnTheOther) {
  const Experiments experiments = {std::make_shared<Effort>()};
  const Eigen::VectorXf ones = Eigen::VectorXf::Ones(800);
  const Judge judge(experiments, ones, {}, {});
  const CounterRandom random(3, 1);
  Eigen::VectorXf noise(800);
  for (int i = 0; i < 800; ++i) {
    noise[i] = static_cast<float>(random.normal(static_cast<std::uint64_t>(i)));
  }
  const auto gaps = [&](float learned, float held_out) {
    return one_sided_gaps(judge, learned * noise, judge, held_out * noise);
  };
  EXPECT_TRUE(gaps(1.0f, 1.0f).empty());
  EXPECT_TRUE(gaps(1.0f, 1.6f).empty());  // not certain
  EXPECT_TRUE(gaps(5.0f, 5.0f).empty());  // on both sides: a gap like any other
  ASSERT_EQ(gaps(1.0f, 5.0f).size(), 1u);
  ASSERT_EQ(gaps(5.0f, 1.0f).size(), 1u);
  const OneSidedGap gap = gaps(1.0f, 5.0f).front();
  EXPECT_EQ(gap.channel, "axis/effort");
  EXPECT_NEAR(gap.learned, 1.0, 0.1);
  EXPECT_NEAR(gap.held_out, 5.0, 0.5);
  Eigen::VectorXf jolt = noise;
  jolt[400] = 300.0f;  // in one block only: by chance
  EXPECT_TRUE(one_sided_gaps(judge, noise, judge, jolt).empty());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
