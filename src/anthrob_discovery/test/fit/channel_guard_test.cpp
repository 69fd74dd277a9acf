#include "fit/channel_guard.h"

#include <gtest/gtest.h>

#include <memory>

#include "anthrob_sim/model/robot_model.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr std::size_t kGuardedBins = 40;

/// Of two channels, one wants the damping x of the elbow to be 1 and, for the law is not quite
/// right, the shoulder's damping y to be 0.5 in the second half of the time; the other one, which
/// is near its floor, gets worse with y.
struct Wishes {
  double x, y;         ///< of the first channel, how much
  double other = 1.2;  ///< gap of the other channel, without y
};
class TwoChannels final : public Experiment {
 public:
  explicit TwoChannels(const Wishes& wish) : wish_(wish) {
    channels_ = {{"elbow", "position", "rad", 0, 0, kGuardedBins, 0.0},
                 {"shoulder", "position", "rad", 0, kGuardedBins, kGuardedBins, 0.0}};
    present_.assign(2 * kGuardedBins, 1);
    bin_ = 0.1;
    duration_ = bin_ * static_cast<double>(kGuardedBins);
  }

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
               float* out) const override {
    const double x = damping(*model, "elbow"), y = damping(*model, "shoulder");
    for (std::size_t b = 0; b < kGuardedBins; ++b) {
      const double wrong = b < kGuardedBins / 2 ? 0.0 : wish_.y * (y - 0.5);
      out[b] = static_cast<float>(wish_.x * (x - 1.0) + wrong);
      out[kGuardedBins + b] = static_cast<float>(wish_.other + y);
    }
  }

 private:
  static double damping(const RobotModel& model, const std::string& joint) {
    const auto index = static_cast<std::size_t>(model.skeleton->find_joint(joint));
    return model.skeleton->joints[index].friction.viscous;
  }

  Wishes wish_;
};

struct Case {
  Evaluator evaluator{ANTHROB_CONFIG_DIR "/anthrob/model_I.yaml",
                      {damping("elbow"), damping("shoulder")},
                      0.001,
                      1};
  Experiments experiments;
  ModelFit fit;
  Judge judge;
  Eigen::VectorXf reference;
  Fitted fitted;

  explicit Case(const Wishes& wish)
      : experiments{std::make_shared<TwoChannels>(wish)},
        fit(evaluator, experiments, ones(), {}),
        judge(experiments, fit.whitening(), {}, {}) {
    Variant none;
    none.nuisances = {0.0, 0.0};
    reference = fit.residual(none);
    fitted = fit.start(none, nuisance_unknowns(evaluator));
    fit.improve(fitted, 10, 1e-6);
  }

  static Eigen::VectorXf ones() { return Eigen::VectorXf::Ones(2 * kGuardedBins); }
  static ModelParameter damping(const std::string& joint) {
    return {"joints." + joint + ".friction.viscous", "Nms/rad", 0.0, 0.0, 4.0, 0.1};
  }

  double gap(const Fitted& of, const char* channel) const {
    return judge.channel_gaps(of.residual).at(channel);
  }
  Fitted spared() const { return spare_channels(fit, judge, reference, fitted); }
};

TEST(ChannelGuard, AChannelThatPaysPaysNoMore) {
  const Case made({20.0, 4.0});
  ASSERT_GT(made.gap(made.fitted, "shoulder/position"), 1.3);  // as it was at 1.2
  const Fitted spared = made.spared();
  EXPECT_LT(made.gap(spared, "shoulder/position"), 1.26);
  EXPECT_LT(made.gap(spared, "elbow/position"), 1.1);  // of 20
  EXPECT_NEAR(spared.unknowns[0].read(spared.variant), 1.0, 0.1);
  // What belongs to it is that of the residual as it is.
  EXPECT_NEAR(spared.cost, made.fit.start(spared.variant, spared.unknowns).cost, 1e-3);
  EXPECT_NEAR(spared.sensitivity(kGuardedBins, 1), spared.unknowns[1].scale, 1e-3);
}

TEST(ChannelGuard, PaysAShareOfTheGainAtMost) {
  const Case made({0.1, 4.0});  // the first channel gains by y only
  const double first = 0.5 * made.reference.cast<double>().squaredNorm();
  ASSERT_GT(made.gap(made.fitted, "shoulder/position"), 1.3);
  const Fitted spared = made.spared();
  EXPECT_GT(made.gap(spared, "shoulder/position"), 1.23);
  EXPECT_LE(spared.cost, made.fitted.cost + 0.05 * (first - made.fitted.cost));
}

TEST(ChannelGuard, PaysNoMoreThanAChannelGains) {
  const Case made({20.0, 10.0});  // what it would like to have costs the first one a lot
  ASSERT_GT(made.gap(made.fitted, "shoulder/position"), 1.5);
  const Fitted spared = made.spared();
  EXPECT_GT(made.gap(spared, "shoulder/position"), 1.4);
}

TEST(ChannelGuard, ANoiseThatWasThoughtLargerDoesNotPay) {
  const Case made({20.0, 4.0, 0.6});
  ASSERT_GT(made.gap(made.fitted, "shoulder/position"), 0.7);
  EXPECT_EQ(made.spared().residual, made.fitted.residual);
}

TEST(ChannelGuard, LeavesAloneWhatCostsNoChannelAnything) {
  const Case made({20.0, 0.0});
  const Fitted spared = made.spared();
  EXPECT_EQ(spared.variant.nuisances, made.fitted.variant.nuisances);
  EXPECT_EQ(spared.residual, made.fitted.residual);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
