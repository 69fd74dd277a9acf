// What an interval has to know: noise in time, and that a law may have another shape.
#include "anthrob_calib/discovery/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_calib/discovery/regimes.h"
#include "anthrob_sim/core/random.h"

namespace anthrob {
namespace discovery {
namespace {

/// One channel of a joint that swings to and fro, 4 s.
class Swing final : public Experiment {
 public:
  Swing() {
    bin_ = 0.02;
    duration_ = 4.0;
    channels_ = {{"hinge", "position", "rad", 0, 0, 200, 0.0}};
    present_.assign(200, 1);
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

TEST(RegimeGaps, ShowWhereThePlaceDisagrees) {
  const Experiments experiments = {std::make_shared<Swing>()};
  Eigen::VectorXf residual(200);
  for (std::size_t b = 0; b < 200; ++b) {
    residual[static_cast<Eigen::Index>(b)] = speed_at(b) > 0.8 ? -5.0f : 1.0f;
  }
  const auto rows = regime_gaps(experiments, {speed()}, residual, Eigen::VectorXf::Ones(200));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].place, "hinge");
  EXPECT_EQ(rows[0].word, "speed");
  EXPECT_FLOAT_EQ(static_cast<float>(rows[0].gap[0]), 1.0f);
  EXPECT_FLOAT_EQ(static_cast<float>(rows[0].gap[1]), 1.0f);
  EXPECT_GT(rows[0].gap[2], 3.0);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
