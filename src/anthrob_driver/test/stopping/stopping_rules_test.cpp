// The table of what stops the motors is complete.
#include "stopping/stopping_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace anthrob {
namespace driver {
namespace {

TEST(StoppingRules, EveryFindingThatStopsHasOneAndNoOther) {
  for (const FindingInfo& finding : kFindings) {
    const bool has_rule =
        std::any_of(std::begin(kStoppingRules), std::end(kStoppingRules),
                    [&](const StoppingRule& rule) { return rule.finding == finding.finding; });
    EXPECT_EQ(has_rule, finding.stops) << finding.name;
  }
}

TEST(StoppingRules, AreFoundByFindingAndByWhoNoticedIt) {
  for (const StoppingRule& rule : kStoppingRules) {
    EXPECT_EQ(&stopping_rule(rule.finding, rule.noticed_by), &rule) << info(rule.finding).name;
  }
  EXPECT_THROW(stopping_rule(Finding::kLateCycle, NoticedBy::kBusWatch), std::logic_error);
  EXPECT_THROW(stopping_rule(Finding::kBusOff, NoticedBy::kEcu), std::logic_error);
}

TEST(StoppingRules, StandInTheOrderInWhichTheyAreLookedAt) {
  EXPECT_TRUE(std::is_sorted(std::begin(kStoppingRules), std::end(kStoppingRules),
                             [](const StoppingRule& a, const StoppingRule& b) {
                               return a.noticed_by < b.noticed_by;
                             }));
}

TEST(StoppingRules, OnlyThoseAboutAnEcuHaveAConditionAndMayWaitForAReason) {
  for (const StoppingRule& rule : kStoppingRules) {
    const bool of_ecu = rule.noticed_by == NoticedBy::kEcu;
    EXPECT_EQ(rule.holds != nullptr, of_ecu) << info(rule.finding).name;
    if (rule.reaction == Reaction::kDisableThenExplain) {
      EXPECT_TRUE(of_ecu) << info(rule.finding).name;
    }
    if (!of_ecu && rule.noticed_by != NoticedBy::kMuscleWatch) {
      EXPECT_EQ(rule.concerned, Concerned::kNone) << info(rule.finding).name;
    }
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
