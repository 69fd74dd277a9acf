#include "search/named_effect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "made_experiment.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr std::size_t kFewBins = 10;

/// What tells gaps of the elbow's position, its only channel.
struct Held {
  Experiments experiments = {
      std::make_shared<MadeExperiment>([](double, double, double) { return 0.0; },
                                       [](double, double, double) { return 0.0; }, kFewBins)};
  Eigen::VectorXf whitening = Eigen::VectorXf::Ones(kFewBins);
  Judge judge{experiments, whitening, {}, {}};

  static Eigen::VectorXf gap(double size) {
    return Eigen::VectorXf::Constant(kFewBins, static_cast<float>(size));
  }
};

TEST(NamedEffect, LeavesAShareOfWhatStoodAboveTheNoiseWhereItShows) {
  const Held held;
  std::vector<NamedEffect> effects(2);
  note_what_it_changes(held.judge, held.gap(4.0), held.gap(2.0), effects[0]);
  EXPECT_EQ(effects[0].found.shows_in, "elbow/position");
  const auto above = [](double gap) { return gap * gap - 1.15 * 1.15; };
  EXPECT_NEAR(effects[0].before, above(4.0), 1e-5);
  EXPECT_NEAR(effects[0].lowered, 12.0, 1e-5);
  measure_what_is_left(held.judge, held.gap(5.0), held.gap(1.5), effects);
  EXPECT_NEAR(effects[0].found.left, above(1.5) / above(5.0), 1e-6);  // of all that was there first
  EXPECT_EQ(effects[1].found.left, 1.0);                              // shows nowhere
  measure_what_is_left(held.judge, held.gap(2.0), held.gap(1.5), effects);
  EXPECT_NEAR(effects[0].found.left, above(1.5) / above(4.0), 1e-6);  // more, when it came in
  effects[0].before = 0.0;
  measure_what_is_left(held.judge, held.gap(1.0), held.gap(1.5), effects);
  EXPECT_EQ(effects[0].found.left, 1.0);  // there was nothing for it to explain
  note_what_it_changes(held.judge, held.gap(1.0), held.gap(2.0), effects[1]);
  EXPECT_TRUE(effects[1].found.shows_in.empty());  // it takes nothing away
  EXPECT_EQ(effects[1].lowered, 0.0);
}

TEST(NamedEffect, IsNotImprobableForRivalsThatDoAsWell) {
  std::vector<NamedEffect> effects(3);
  effects[0].found.probability = 0.15;
  for (int i = 0; i < 5; ++i)
    effects[0].found.rivals.push_back({"payload", "Payload", "forearm", 0.15, 0.0});
  effects[1].found.probability = 0.8;
  effects[1].gained = 200.0;
  effects[1].found.left = 0.3;
  effects[2].found.probability = 0.9;
  effects[2].gained = 100.0;
  EXPECT_EQ(least_of_improbable(effects, true, {}), nullptr);
  effects[1].found.left = 0.45;  // a tenth of it is left
  EXPECT_EQ(least_of_improbable(effects, true, {}), &effects[1]);
  effects[2].found.left = 0.5;
  EXPECT_EQ(least_of_improbable(effects, true, {}), &effects[2]);  // it does less
  EXPECT_EQ(least_of_improbable({}, true, {}), nullptr);
  EXPECT_EQ(least_of_improbable(effects, false, {}), nullptr);
  effects[1].found.spoilt = 0.2;  // of what it explains: the odds are 1 to 10
  EXPECT_EQ(least_of_improbable(effects, false, {}), &effects[1]);
}

TEST(NamedEffect, IsChargedWithTheChannelThatItSpoils) {
  const Held held;
  std::vector<NamedEffect> effects(3);
  note_what_it_changes(held.judge, held.gap(1.5), held.gap(1.0), effects[0]);
  EXPECT_TRUE(effects[0].raised.empty());
  note_what_it_changes(held.judge, held.gap(1.0), held.gap(1.3), effects[1]);
  note_what_it_changes(held.judge, held.gap(1.3), held.gap(2.0), effects[2]);
  EXPECT_NEAR(effects[2].raised.at("elbow/position"), 4.0 - 1.69, 1e-5);
  const auto charged = [&](double first, double left) {
    const bool any = charge_spoilt_channels(held.judge, held.gap(first), held.gap(left), effects);
    std::vector<std::string> of;
    for (const NamedEffect& effect : effects) of.push_back(effect.found.spoils);
    EXPECT_EQ(any, of != std::vector<std::string>(3));
    return of;
  };
  // The one that raised it most, though the other one did so, too.
  EXPECT_EQ(charged(1.5, 1.9), (std::vector<std::string>{"", "", "elbow/position"}));
  EXPECT_EQ(charged(1.5, 1.7), std::vector<std::string>(3));  // less than a fifth worse
  EXPECT_EQ(charged(0.3, 1.1), std::vector<std::string>(3));  // noise still
  EXPECT_EQ(charged(0.3, 1.3), (std::vector<std::string>{"", "", "elbow/position"}));
  // Little is spoilt for a law that explains much.
  effects[2].lowered = 100.0;
  charged(0.3, 1.3);
  EXPECT_NEAR(effects[2].found.spoilt, 0.0069, 1e-6);
  charged(1.5, 1.7);
  EXPECT_EQ(effects[2].found.spoilt, 0.0);
  effects.resize(1);  // what it never raised is not its work
  EXPECT_FALSE(charge_spoilt_channels(held.judge, held.gap(1.5), held.gap(1.9), effects));
  EXPECT_TRUE(effects[0].found.spoils.empty());
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
