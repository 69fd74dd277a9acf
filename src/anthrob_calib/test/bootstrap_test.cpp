// What an interval has to know: noise in time, and that a law may have another shape.
#include "anthrob_calib/discovery/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_calib/discovery/judge.h"
#include "anthrob_calib/discovery/regimes.h"
#include "anthrob_sim/core/random.h"

namespace anthrob {
namespace discovery {
namespace {

/// One channel of a joint that swings to and fro, 4 s; after one of a muscle, if that was measured.
class Swing final : public Experiment {
 public:
  explicit Swing(bool with_muscle = false) {
    bin_ = 0.02;
    duration_ = 4.0;
    if (with_muscle) channels_ = {{"flexor", "force", "N", 0, 0, 200, 0.0}};
    channels_.push_back({"hinge", "position", "rad", 0, with_muscle ? 200u : 0u, 200, 0.0});
    present_.assign(200 * channels_.size(), 1);
  }
  void compare(const std::shared_ptr<const RobotModel>&, Starts&, float*) const override {}
};

double speed_at(std::size_t bin) {
  return std::sin(0.9 * static_cast<double>(bin));
}

MeasuredVariable speed() {
  MeasuredVariable variable{"hinge/position", "speed", {{}}, false};
  for (std::size_t b = 0; b < 200; ++b) variable.values[0].push_back(speed_at(b));
  return variable;
}

/// A size to which all rows are equally sensitive, fitted: residuals add up to nothing.
Fitted fit_with(const std::function<double(std::size_t)>& residual) {
  Fitted fitted;
  Unknown u;
  u.nuisance = 0;
  u.lower = -10.0;
  u.upper = 10.0;
  fitted.unknowns = {u};
  fitted.variant.nuisances = {1.0};
  fitted.sensitivity.setOnes(200, 1);
  fitted.residual.resize(200);
  for (std::size_t b = 0; b < 200; ++b) {
    fitted.residual[static_cast<Eigen::Index>(b)] = static_cast<float>(residual(b));
  }
  fitted.residual.array() -= fitted.residual.mean();
  return fitted;
}

double width(const Fitted& fitted) {
  const Experiments experiments = {std::make_shared<Swing>()};
  const auto intervals = bootstrap_intervals(fitted, experiments, {speed()}, 1);
  EXPECT_LE(intervals[0].first, 1.0);
  EXPECT_GE(intervals[0].second, 1.0);
  return intervals[0].second - intervals[0].first;
}

TEST(Bootstrap, IntervalOfNoiseIsTheFormulaOne) {
  const CounterRandom random(3);
  const double w = width(fit_with([&](std::size_t b) { return random.normal(b); }));
  EXPECT_NEAR(w, 2.0 * 1.96 / std::sqrt(200.0), 0.15);
}

TEST(Bootstrap, LawThatFitsNeitherSlowNorFastIsUncertain) {
  // As large as the noise of the other test, but of one mind at each speed.
  const double w = width(fit_with([](std::size_t b) { return std::sqrt(2.0) * speed_at(b); }));
  EXPECT_GT(w, 1.0);
}

TEST(RegimeGaps, RecordingsMayLackChannels) {
  const Experiments experiments = {std::make_shared<Swing>(true), std::make_shared<Swing>()};
  Eigen::VectorXf residual = Eigen::VectorXf::Ones(600);
  residual.head(200) *= 7.0f;  // the muscle
  MeasuredVariable both = speed();
  both.values.push_back(both.values.front());
  const auto rows = regime_gaps(experiments, {both}, residual, Eigen::VectorXf::Ones(600), {});
  ASSERT_EQ(rows.size(), 1u);  // nothing says how the muscle was used
  for (const double gap : rows[0].gap) EXPECT_DOUBLE_EQ(gap, 1.0);
  ASSERT_EQ(channels_of(experiments).size(), 2u);
  EXPECT_EQ(find_channel(*experiments[1], channels_of(experiments)[0]), nullptr);
}

/// 19.99 s in bins of 0.06 s: the middle of the last one is at 20.01 s.
class LongSwing final : public Experiment {
 public:
  LongSwing() {
    bin_ = 0.06;
    duration_ = 19.99;
    channels_ = {{"hinge", "position", "rad", 0, 0, 334, 0.0}};
    present_.assign(334, 1);
  }
  void compare(const std::shared_ptr<const RobotModel>&, Starts&, float*) const override {}
};

TEST(Judge, LastBinBelongsToTheLastBlock) {
  const Experiments experiments = {std::make_shared<LongSwing>()};
  const Eigen::VectorXf factors = Eigen::VectorXf::Ones(334);
  const Judge judge(experiments, factors, {});
  ASSERT_EQ(judge.block_count(), 10u);
  Eigen::VectorXf residual = Eigen::VectorXf::Zero(334);
  residual[333] = 2.0f;
  const Eigen::MatrixXd scores = judge.block_scores({residual, Eigen::VectorXf::Zero(334)}, 1);
  EXPECT_LT(scores(0, 9), -0.5);
  EXPECT_DOUBLE_EQ(scores(0, 0), 0.0);
}

TEST(RegimeGaps, ShowWhereThePlaceDisagrees) {
  const Experiments experiments = {std::make_shared<Swing>()};
  Eigen::VectorXf residual(200);
  for (std::size_t b = 0; b < 200; ++b) {
    residual[static_cast<Eigen::Index>(b)] = speed_at(b) > 0.8 ? -5.0f : 1.0f;
  }
  ChannelScale scale;
  scale.inflation = 4.0;  // taken off by the whitener, given back here
  const auto rows = regime_gaps(experiments, {speed()}, residual, Eigen::VectorXf::Ones(200),
                                {{"hinge/position", scale}});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].place, "hinge");
  EXPECT_EQ(rows[0].word, "speed");
  EXPECT_DOUBLE_EQ(rows[0].gap[0], 2.0);
  EXPECT_DOUBLE_EQ(rows[0].gap[1], 2.0);
  EXPECT_GT(rows[0].gap[2], 6.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
