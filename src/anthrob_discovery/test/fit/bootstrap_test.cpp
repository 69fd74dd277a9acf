// What an interval has to know: noise in time, and that a law may have another shape.
#include "fit/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_core/random.h"
#include "experiment/regimes.h"
#include "judgement/judge.h"
#include "swing.h"

namespace anthrob {
namespace discovery {
namespace {

using namespace testing_support;

/// A size to which all rows are equally sensitive, fitted: residuals add up to nothing.
Fitted fit_with(const std::function<double(std::size_t)>& residual) {
  Fitted fitted;
  Unknown u;
  u.nuisance = 0;
  u.lower = -10.0;
  u.upper = 10.0;
  fitted.unknowns = {u};
  fitted.variant.nuisances = {1.0};
  fitted.sensitivity.setOnes(kBins, 1);
  fitted.residual.resize(kBins);
  for (std::size_t b = 0; b < kBins; ++b) {
    fitted.residual[static_cast<Eigen::Index>(b)] = static_cast<float>(residual(b));
  }
  fitted.residual.array() -= fitted.residual.mean();
  return fitted;
}

double width(const Fitted& fitted) {
  const Experiments experiments = {std::make_shared<Swing>()};
  const auto intervals = bootstrap_intervals(fitted, experiments, {speed()}, 1, {}, 2.0);
  EXPECT_LE(intervals[0].first, 1.0);
  EXPECT_GE(intervals[0].second, 1.0);
  return intervals[0].second - intervals[0].first;
}

TEST(Bootstrap, IntervalsOfNoiseCoverTheTruth) {
  constexpr int kRuns = 200;
  int covered = 0;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const CounterRandom random(static_cast<std::uint64_t>(run));
    double error = 0.0;  // of the fit: the mean of the noise
    for (std::size_t b = 0; b < kBins; ++b) error += random.normal(b) / kBins;
    const double w = width(fit_with([&](std::size_t b) { return random.normal(b); }));
    covered += std::abs(error) <= 0.5 * w ? 1 : 0;
    sum += w / kRuns;
  }
  EXPECT_GE(covered, 0.90 * kRuns);
  EXPECT_LE(covered, 0.99 * kRuns);
  const double formula = 2.0 * 1.96 / std::sqrt(kBins);
  EXPECT_NEAR(sum / formula, 1.1, 0.2);
}

/// 40 bins of noise in a recording of two seconds, and one bin more or not.
class Glimpse final : public Experiment {
 public:
  explicit Glimpse(std::size_t bins) {
    bin_ = 0.05;
    duration_ = 2.0;
    channels_ = {{"hinge", "position", "rad", 0, 0, bins, 0.0}};
    present_.assign(bins, 1);
  }
  void compare(const std::shared_ptr<const RobotModel>&, const Starts&, float*) const override {}
};

TEST(Bootstrap, OneBlockOfTimeIsAsUncertainAsItsNoise) {
  const CounterRandom random(1);
  for (const std::size_t bins : {std::size_t{40}, std::size_t{41}}) {
    Fitted fitted = fit_with([&](std::size_t b) { return random.normal(b); });
    fitted.sensitivity.setOnes(static_cast<Eigen::Index>(bins), 1);
    fitted.residual.conservativeResize(static_cast<Eigen::Index>(bins));
    const Experiments experiments = {std::make_shared<Glimpse>(bins)};
    const auto interval = bootstrap_intervals(fitted, experiments, {}, 1, {}, 2.0)[0];
    const double noise = 2.0 * 1.96 / std::sqrt(static_cast<double>(bins));
    EXPECT_GE(interval.second - interval.first, 0.999 * noise) << bins;
    EXPECT_LE(interval.second - interval.first, 1.5 * noise) << bins;
  }
}

TEST(Bootstrap, NothingToBeFoundHasNoIntervals) {
  Fitted fitted = fit_with([](std::size_t b) { return speed_at(b); });
  fitted.unknowns.clear();
  fitted.sensitivity.resize(kBins, 0);
  const Experiments experiments = {std::make_shared<Swing>()};
  EXPECT_TRUE(bootstrap_intervals(fitted, experiments, {speed()}, 1, {}, 2.0).empty());
}

TEST(Bootstrap, LawThatFitsNeitherSlowNorFastIsUncertain) {
  // As large as the noise of the other test, but of one mind at each speed.
  const double w = width(fit_with([](std::size_t b) { return std::sqrt(2.0) * speed_at(b); }));
  EXPECT_GT(w, 1.0);
}

/// An effect of size 3 (nothing at 1) that an ordinary parameter imitates but for a part; no noise.
double relative_reach(float imitated) {
  Fitted fitted;
  Unknown ordinary, size;
  ordinary.nuisance = 0;
  size.effect = 0;
  size.parameter = "size";
  size.neutral = 1.0;
  size.scale = 0.5;
  ordinary.lower = size.lower = -10.0;
  ordinary.upper = size.upper = 10.0;
  fitted.unknowns = {ordinary, size};
  fitted.variant.nuisances = {0.0};
  fitted.variant.effects = {{"friction", "hinge", {{"size", 3.0}}}};
  fitted.sensitivity.resize(kBins, 2);
  for (std::size_t b = 0; b < kBins; ++b) {
    const auto row = static_cast<Eigen::Index>(b);
    const float own = b % 2 == 0 ? 7.0f : -7.0f;
    fitted.sensitivity(row, 0) = 5.0f;
    fitted.sensitivity(row, 1) = imitated * 7.0f + std::sqrt(1.0f - imitated * imitated) * own;
  }
  fitted.residual.setZero(kBins);
  const Experiments experiments = {std::make_shared<Swing>()};
  const auto interval = bootstrap_intervals(fitted, experiments, {speed()}, 1, {}, 2.0)[1];
  EXPECT_NEAR(interval.first + interval.second, 6.0, 1e-9);
  return 0.5 * (interval.second - interval.first) / 2.0;
}

TEST(Bootstrap, WhatIsReadOffDetailsIsAsUncertainAsTheLawsShape) {
  EXPECT_NEAR(relative_reach(0.0f), 0.05 * 1.96, 1e-4);
  EXPECT_NEAR(relative_reach(0.8f), 0.05 * 1.96 / 0.6, 1e-4);
}

TEST(RegimeGaps, RecordingsMayLackChannels) {
  const Experiments experiments = {std::make_shared<Swing>(true), std::make_shared<Swing>()};
  Eigen::VectorXf residual = Eigen::VectorXf::Ones(3 * kBins);
  residual.head(kBins) *= 7.0f;  // the muscle
  MeasuredVariable both = speed();
  both.values.push_back(both.values.front());
  const auto rows =
      regime_gaps(experiments, {both}, residual, Eigen::VectorXf::Ones(3 * kBins), {});
  ASSERT_EQ(rows.size(), 1u);  // nothing says how the muscle was used
  for (const auto& gap : rows[0].gap) EXPECT_DOUBLE_EQ(gap.value(), 1.0);
  ASSERT_EQ(channels_of(experiments).size(), 2u);
  EXPECT_EQ(find_channel(*experiments[1], channels_of(experiments)[0]), nullptr);
}

/// 19.99 s in bins of 0.06 s: the middle of the last one is at 20.01 s.
class LongSwing final : public Experiment {
 public:
  explicit LongSwing(double duration = 19.99) {
    bin_ = 0.06;
    duration_ = duration;
    channels_ = {{"hinge", "position", "rad", 0, 0, 334, 0.0}};
    present_.assign(334, 1);
  }
  void compare(const std::shared_ptr<const RobotModel>&, const Starts&, float*) const override {}
};

TEST(Judge, LastBinBelongsToTheLastBlock) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  const Judge judge(experiments, factors, {}, {});
  ASSERT_EQ(judge.block_count(), 10u);
  Eigen::VectorXf residual = Eigen::VectorXf::Zero(334);
  residual[333] = 2.0f;
  const Eigen::MatrixXd scores = judge.block_scores({residual, Eigen::VectorXf::Zero(334)}, 1);
  EXPECT_LT(scores(0, 9), -0.5);
  EXPECT_DOUBLE_EQ(scores(0, 0), 0.0);
}

TEST(Judge, ARestIsNoBlockOfItsOwn) {
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  for (const auto& [duration, blocks] : {std::pair(20.0, 10u), {20.6, 10u}, {0.5, 1u}}) {
    EXPECT_EQ(Judge({std::make_shared<LongSwing>(duration)}, factors, {}, {}).block_count(),
              blocks);
  }
}

TEST(Judge, AGapInEveryBlockIsSignificantOneInASingleBlockIsNot) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  const Judge judge(experiments, factors, {}, {});
  Eigen::VectorXf residual(334);
  for (Eigen::Index b = 0; b < 334; ++b) residual[b] = 2.0f + 0.5f * std::sin(0.1f * b);
  EXPECT_GT(judge.excess_significance(residual, 1.4).at("hinge/position"), 3.0);
  EXPECT_LT(judge.excess_significance(residual, 3.0).at("hinge/position"), -3.0);
  residual.setZero();
  residual.head(20).setConstant(20.0f);  // as large on the whole
  EXPECT_GT(judge.channel_gaps(residual).at("hinge/position"), 4.0);
  EXPECT_LT(judge.excess_significance(residual, 1.4).at("hinge/position"), 1.0);
}

TEST(Judge, GrowthInEveryBlockIsSignificantGrowthInASingleBlockIsNot) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  const Judge judge(experiments, factors, {}, {});
  Eigen::VectorXf before(334);
  for (Eigen::Index b = 0; b < 334; ++b) before[b] = 1.0f + 0.5f * std::sin(0.1f * b);
  const auto growth = [&](const Eigen::VectorXf& after) {
    return judge.growth_significance(before, after).at("hinge/position");
  };
  EXPECT_EQ(growth(before), 0.0);
  EXPECT_GT(growth(1.1f * before), 3.0);
  EXPECT_LT(growth(0.9f * before), -3.0);
  Eigen::VectorXf once = before;
  once.head(30) *= 2.0f;
  EXPECT_GT(judge.channel_gaps(once).at("hinge/position"),
            1.1 * judge.channel_gaps(before).at("hinge/position"));
  EXPECT_GT(growth(once), 0.0);
  EXPECT_LT(growth(once), 2.0);
}

TEST(Judge, CorrelatedNoiseIsDividedOutOnce) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  ChannelScale scale;
  scale.inflation = 4.0;  // taken off by the whitener
  const Judge plain(experiments, factors, {}, {}),
      inflated(experiments, factors, {{"hinge/position", scale}}, {});
  Eigen::VectorXf noise(334);
  for (Eigen::Index b = 0; b < 334; ++b) noise[b] = (b / 4) % 3 == 0 ? 1.2f : -0.9f;
  const Eigen::MatrixXd as_is = plain.block_scores({noise}, 0),
                        taken_off = inflated.block_scores({0.5f * noise}, 0);
  ASSERT_EQ(as_is.cols(), taken_off.cols());
  EXPECT_LT((as_is - taken_off).cwiseAbs().maxCoeff(), 1e-4 * as_is.cwiseAbs().maxCoeff());
}

TEST(Judge, WhatIsMeasuredInEverySecondBinIsAsCorrelatedAsItIs) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  Eigen::VectorXf factors = Eigen::VectorXf::Zero(334), residual = factors, measured(167);
  const CounterRandom random(5);
  float memory = 0.0f;
  for (Eigen::Index b = 0; b < 167; ++b) {
    memory = 0.8f * memory + static_cast<float>(random.normal(static_cast<std::uint64_t>(b)));
    measured[b] = residual[2 * b] = memory;
    factors[2 * b] = 1.0f;
  }
  const double length = correlation_length(measured);
  ASSERT_GT(length, 4.0);
  // Each independent one is worth half a nat.
  const double sum = Judge(experiments, factors, {}, {}).block_scores({residual}, 0).sum();
  EXPECT_NEAR(sum, -0.5 * 167.0 / length, 1e-3 * 167.0);
}

TEST(CertainGap, IsInBothAndInBlockAfterBlockOrClearlyLarge) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  const Judge judge(experiments, factors, {}, {});
  const auto certain = [&](const Eigen::VectorXf& learned, const Eigen::VectorXf& held_out) {
    return certain_gap(judge, learned, judge, held_out, 1.4);
  };
  Eigen::VectorXf even(334), uneven = Eigen::VectorXf::Zero(334);
  for (Eigen::Index b = 0; b < 334; ++b) even[b] = b % 3 == 0 ? 1.7f : -1.5f;
  uneven.head(40).setConstant(4.7f);  // 1.63 on the whole
  EXPECT_TRUE(certain(even, even));
  EXPECT_FALSE(certain(uneven, uneven));
  EXPECT_TRUE(certain(1.4f * uneven, 1.4f * uneven));
  EXPECT_FALSE(certain(0.8f * even, even));
  EXPECT_FALSE(certain(even, 0.8f * even));
}

TEST(RegimeGaps, ShowWhereThePlaceDisagrees) {
  const Experiments experiments = {std::make_shared<Swing>()};
  Eigen::VectorXf residual(kBins);
  for (std::size_t b = 0; b < kBins; ++b) {
    residual[static_cast<Eigen::Index>(b)] = speed_at(b) > 0.8 ? -5.0f : 1.0f;
  }
  ChannelScale scale;
  scale.inflation = 4.0;  // taken off by the whitener, given back here
  const auto rows = regime_gaps(experiments, {speed()}, residual, Eigen::VectorXf::Ones(kBins),
                                {{"hinge/position", scale}});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].place, "hinge");
  EXPECT_EQ(rows[0].word, "speed");
  EXPECT_DOUBLE_EQ(rows[0].gap[0].value(), 2.0);
  EXPECT_DOUBLE_EQ(rows[0].gap[1].value(), 2.0);
  EXPECT_GT(rows[0].gap[2].value(), 6.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
