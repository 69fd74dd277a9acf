// What a residual depends on: one measured quantity, or two together.
#include "diagnosis/dependence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "anthrob_core/random.h"
#include "diagnosis/step_means.h"
#include "swing.h"

namespace anthrob {
namespace discovery {
namespace {

using namespace testing_support;

using OfBin = std::function<double(std::size_t)>;

MeasuredVariable variable(const std::string& name, const std::string& word, const OfBin& value) {
  MeasuredVariable made{name, word, {{}}, false, "N"};
  for (std::size_t b = 0; b < kBins; ++b) made.values[0].push_back(value(b));
  return made;
}

MeasuredVariable time() {
  return variable("time", "time", [](std::size_t b) { return 0.02 * static_cast<double>(b); });
}

MeasuredVariable direction() {
  MeasuredVariable made = variable("hinge/position", "sign of velocity", speed_at);
  made.sign = true;
  return made;
}

/// Between 0 and 4 N, all values equally often, and whatever the speed.
double load_at(std::size_t bin) {
  return 4.0 * std::fmod(0.6180339887498949 * static_cast<double>(bin), 1.0);
}

MeasuredVariable load() {
  return variable("hinge/load", "load", load_at);
}

/// Of a residual beside noise with a standard deviation of 1.
Dependence dependence_of(const std::vector<MeasuredVariable>& variables, const OfBin& law) {
  const CounterRandom random(3);
  Eigen::VectorXf residual(kBins);
  for (std::size_t b = 0; b < kBins; ++b) {
    residual[static_cast<Eigen::Index>(b)] = static_cast<float>(law(b) + random.normal(b));
  }
  return find_dependences({std::make_shared<Swing>()}, variables, residual,
                          Eigen::VectorXf::Ones(kBins), {}, 2.0)
      .at(0);
}

TEST(Dependence, IsBeyondWhatAConstantDoes) {
  const auto of = [&](double offset, double slope) {
    return dependence_of({time(), speed()},
                         [=](std::size_t b) { return offset + slope * speed_at(b); });
  };
  const Dependence flat = of(2.0, 0.0), sloped = of(2.0, 2.0), noise = of(0.0, 0.0);
  EXPECT_NEAR(flat.constant, 0.8, 0.03);  // 4 of 4 + 1
  EXPECT_LT(flat.share, DependenceOptions{}.telling);
  EXPECT_EQ(sloped.word, "speed");
  EXPECT_NEAR(sloped.constant, 4.0 / 7.0, 0.03);
  EXPECT_NEAR(sloped.share, 2.0 / 7.0, 0.03);
  EXPECT_LT(noise.constant, DependenceOptions{}.telling);
  EXPECT_LT(noise.share, DependenceOptions{}.telling);
}

TEST(Dependence, ExplainsNoMoreThanAllThereIs) {
  // The constant of every second block predicts the others worse than none.
  const Dependence d = dependence_of({time(), speed()}, [](std::size_t b) {
    return 2.0 * speed_at(b) + (b / 100 % 2 ? 1.0 : -1.0);
  });
  EXPECT_GE(d.constant, 0.0);
  EXPECT_GE(d.share, 0.0);
  EXPECT_LE(d.predicted(), 1.0);
}

TEST(Dependence, OnTwoQuantitiesTogether) {
  // Friction that grows with the load: the sign of the velocity alone explains its mean only.
  const Dependence friction = dependence_of({time(), direction(), load()}, [](std::size_t b) {
    return std::copysign(load_at(b), speed_at(b));
  });
  const double whole = 16.0 / 3.0 + 1.0;
  EXPECT_EQ(friction.word, "sign of velocity");
  EXPECT_NEAR(friction.share, 4.0 / whole, 0.04);
  ASSERT_TRUE(friction.second);
  EXPECT_EQ(friction.second->variable, "hinge/load");
  EXPECT_NEAR(friction.second->share, (4.0 / 9.0 + 4.0 + 100.0 / 9.0) / 3.0 / whole, 0.04);
  EXPECT_EQ(friction.predicted(), friction.second->share);
  EXPECT_EQ(friction.on_what(), "sign of velocity of hinge/position and load of hinge/load");
  ASSERT_EQ(friction.second->branches.size(), 3u);
  for (std::size_t level = 0; level < 3; ++level) {
    const Dependence::Branch& branch = friction.second->branches[level];
    EXPECT_NEAR(branch.second, (4.0 / 3.0) * (static_cast<double>(level) + 0.5), 0.05);
    EXPECT_LT(branch.at.front(), 0.0);
    EXPECT_GT(branch.at.back(), 0.0);
    EXPECT_NEAR(branch.mean.front(), -branch.second, 0.3);
    EXPECT_NEAR(branch.mean.back(), branch.second, 0.3);
  }
}

TEST(Dependence, OfASignItTellsWhichOne) {
  const Dependence friction = dependence_of({time(), load(), direction()}, [](std::size_t b) {
    return load_at(b) + std::copysign(1.0, speed_at(b));
  });
  EXPECT_EQ(friction.word, "load");
  ASSERT_TRUE(friction.second);
  EXPECT_EQ(friction.second->word, "sign of velocity");
  ASSERT_EQ(friction.second->branches.size(), 3u);
  for (int sign = -1; sign <= 1; ++sign) {
    EXPECT_EQ(friction.second->branches[static_cast<std::size_t>(sign + 1)].second, sign);
  }
}

TEST(Dependence, ASecondQuantityMustSayMoreThanTheFirst) {
  const OfBin law = [](std::size_t b) { return 2.0 * speed_at(b); };
  const MeasuredVariable same = variable("hinge/position", "posture", speed_at);
  const Dependence alone = dependence_of({time(), speed(), same, load()}, law);
  EXPECT_EQ(alone.word, "speed");
  EXPECT_FALSE(alone.second);
  EXPECT_EQ(alone.predicted(), alone.share);
  EXPECT_EQ(alone.on_what(), "speed of hinge/position");
}

TEST(Dependence, SumsOfTwoQuantitiesShowBoth) {
  const Dependence both = dependence_of({time(), speed(), load()}, [](std::size_t b) {
    return 2.0 * speed_at(b) + load_at(b) - 2.0;
  });
  // Variances: 2 of the speed, 4/3 of the load, and 1 of the noise.
  EXPECT_EQ(both.word, "speed");
  ASSERT_TRUE(both.second);
  EXPECT_EQ(both.second->word, "load");
  EXPECT_NEAR(both.share, 2.0 / (13.0 / 3.0), 0.04);
  EXPECT_NEAR(both.second->share, (2.0 + 32.0 / 27.0) / (13.0 / 3.0), 0.05);
}

TEST(StepMeans, HaveErrorsOverBlocksNotOverBins) {
  // Constant in each block: a hundred bins of one tell no more than one.
  const CounterRandom random(4, 1);
  ChannelResidual together, apart;
  for (std::size_t i = 0; i < 40000; ++i) {
    together.block.push_back(i / 100);
    together.y.push_back(random.normal(i / 100));
    apart.y.push_back(random.normal(1000 + i));
  }
  apart.block = together.block;
  const Steps one{std::vector<std::size_t>(40000, 0), 1};
  const double blocks = 200.0, bins = 20000.0;  // in a half
  EXPECT_NEAR(means_of(together, one, true, 2.0).error[0], 1.0 / std::sqrt(blocks),
              0.15 / std::sqrt(blocks));
  EXPECT_NEAR(means_of(apart, one, true, 2.0).error[0], 1.0 / std::sqrt(bins),
              0.15 / std::sqrt(bins));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
