#include "search/law_elsewhere.h"

#include <gtest/gtest.h>

#include "made_problem.h"
#include "offset_forces.h"

namespace anthrob {
namespace discovery {
namespace {

constexpr std::size_t kMost = 9;

/// The offset of the first muscle is named.
struct OneNamed {
  explicit OneNamed(const OffsetForces::Offsets& truth)
      : problem({}, std::make_shared<OffsetForces>(truth, 1),
                std::make_shared<OffsetForces>(truth, 2), {kLaw, "force_sensor_gain"}),
        base(problem.hypotheses.tested(problem.train.start({}, {}))),
        whole(all_of(problem.train)),
        screening(problem.train, base.fit, problem.candidates, whole, whole, {}),
        elsewhere(problem.hypotheses, screening),
        named({problem.index(kMuscles[0], kLaw)}) {
    Score score;
    score.candidate = named[0];
    score.gain = 1.0;
    score.amount = {1.0, 0.0};
    base = problem.comparison.weigh(base, {score}).entries.at(0);
  }
  std::optional<LawElsewhere::Everywhere> fit(std::size_t most = kMost) const {
    return elsewhere.fit(problem.candidates[named[0]].effect, named, base, most);
  }
  const Effect* repeated(const std::string& law, const std::string& place) const {
    ShortList list;
    list.entries.resize(1);
    list.entries[0].candidate = problem.index(place, law);
    return elsewhere.repeated(list, named);
  }

  MadeProblem problem;
  Tested base;
  Excerpt whole;
  Screening screening;
  LawElsewhere elsewhere;
  std::vector<std::size_t> named;
};

TEST(LawElsewhere, IsALawOfTheListThatIsNamedAtAnotherMuscle) {
  const OneNamed one({{"brachialis", 4.0}, {"biceps_brachii", 3.0}, {"triceps_brachii", -2.0}});
  EXPECT_EQ(one.repeated(kLaw, kMuscles[1]), one.problem.candidates[one.named[0]].effect);
  EXPECT_EQ(one.repeated(kLaw, kMuscles[0]), nullptr);
  EXPECT_EQ(one.repeated(kLaw, "all"), nullptr);
  EXPECT_EQ(one.repeated("force_sensor_gain", kMuscles[1]), nullptr);
}

TEST(LawElsewhere, IsFittedAtAllOtherMusclesEachWithItsSize) {
  const OneNamed one({{"brachialis", 4.0}, {"biceps_brachii", 3.0}, {"triceps_brachii", -2.0}});
  const auto all = one.fit();
  ASSERT_TRUE(all);
  ASSERT_EQ(all->parts.size(), 2u);
  const Variant& variant = all->fit.fit.variant;
  ASSERT_EQ(variant.effects.size(), 3u);
  for (std::size_t p = 0; p < 2; ++p) {
    const EffectInstance& effect = variant.effects[p + 1];
    const ShortList& alone = all->parts[p].alone;
    EXPECT_EQ(one.problem.candidates[alone.entries.at(0).candidate].place, effect.place);
    const double truth = effect.place == "biceps_brachii" ? 3.0 : -2.0;
    EXPECT_NEAR(effect.parameters.at("offset"), truth, 0.3) << effect.place;
    // Without it, all that the muscle misses is left.
    EXPECT_GT(all->parts[p].without.fit.cost, 1.2 * all->fit.fit.cost);
    EXPECT_GT(alone.entries[0].evidence, 3.0);
  }
}

TEST(LawElsewhere, IsNotWhatOneOtherMuscleMisses) {
  const OneNamed one({{"brachialis", 4.0}, {"biceps_brachii", 3.0}, {"triceps_brachii", 0.0}});
  EXPECT_FALSE(one.fit());
}

TEST(LawElsewhere, KeepsWithinTheRoomThereIs) {
  const OneNamed one({{"brachialis", 4.0}, {"biceps_brachii", 3.0}, {"triceps_brachii", -2.0}});
  EXPECT_FALSE(one.fit(1));
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
