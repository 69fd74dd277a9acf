#include "judgement/merit.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace discovery {
namespace {

Merit earned() {
  Merit merit;
  merit.probability = 0.9;
  merit.none = 0.01;
  merit.learned = 300.0;
  merit.evidence = 30.0;
  merit.needed_evidence = 9.4;
  merit.significance = 7.0;
  merit.share = 0.8;
  merit.share_of_first = 0.8;
  return merit;
}

TEST(Merit, WhatMeetsAllConditionsLacksNothing) {
  EXPECT_EQ(lack(earned(), {}), std::nullopt);
}

TEST(Merit, EachConditionAloneDenies) {
  Merit none = earned(), evidence = earned(), significance = earned(), share = earned();
  none.none = 0.95;
  evidence.evidence = 9.0;
  significance.significance = 2.9;
  share.share = share.share_of_first = 0.06;
  EXPECT_EQ(lack(none, {}),
            "it is no more probable than that none of the fitted candidates is right "
            "(probability 0.95)");
  EXPECT_EQ(lack(evidence, {}),
            "it gains only 9.0 nat on held-out recordings; more than 9.4 are required");
  EXPECT_EQ(lack(significance, {}),
            "its gain is only 2.90 standard errors; more than 3 are required");
  EXPECT_EQ(lack(share, {}),
            "it removes only 6.0 % of the squared gap on held-out recordings; more than 10 % are "
            "required");
}

TEST(Merit, WhatUndoesOnlyWhatWasLearnedIsDenied) {
  Merit merit = earned();
  merit.learned = 0.0;
  EXPECT_EQ(lack(merit, {}), "it does not fit the training recordings better");
}

TEST(Merit, AGapThatGrowsIsSaidToGrow) {
  Merit merit = earned();
  merit.share = merit.share_of_first = -0.4;
  EXPECT_EQ(lack(merit, {}), "it does not reduce the squared gap on held-out recordings");
}

TEST(Merit, FaintGapsAskForMore) {
  Merit merit = earned();
  merit.significance = 5.0;
  EXPECT_EQ(lack(merit, {}), std::nullopt);
  merit.only_faint_gaps = true;
  EXPECT_NE(lack(merit, {}), std::nullopt);
}

TEST(Merit, WhatIsSmallBesideTheFirstGapMustBeMoreCertain) {
  Merit merit = earned();
  merit.share_of_first = 0.02;
  EXPECT_NE(lack(merit, {})->find("2.0 % of the initial squared gap"), std::string::npos);
  merit.significance = 8.5;
  EXPECT_EQ(lack(merit, {}), std::nullopt);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
