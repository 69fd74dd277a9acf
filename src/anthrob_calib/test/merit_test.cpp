#include "anthrob_calib/discovery/merit.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace discovery {
namespace {

Merit earned() {
  Merit merit;
  merit.probability = 0.9;
  merit.none = 0.01;
  merit.evidence = 30.0;
  merit.needed_evidence = 9.4;
  merit.significance = 7.0;
  merit.share = 0.8;
  merit.share_of_first = 0.8;
  return merit;
}

TEST(Merit, WhatMeetsAllConditionsLacksNothing) {
  EXPECT_EQ(lack(earned()), "");
}

TEST(Merit, EachConditionAloneDenies) {
  Merit none = earned(), evidence = earned(), significance = earned(), share = earned();
  none.none = 0.95;
  evidence.evidence = 9.0;
  significance.significance = 2.9;
  share.share = share.share_of_first = 0.06;
  EXPECT_EQ(lack(none), "with probability 0.95 none of those that were fitted is right");
  EXPECT_EQ(lack(evidence), "it gains 9.0 nat on held-out data where more than 9.4 are needed");
  EXPECT_EQ(lack(significance), "its gain is 2.90 standard errors where more than 3 are needed");
  EXPECT_EQ(lack(share),
            "it takes 6.0 % of the squared gap on held-out data where more than 10 are needed");
}

TEST(Merit, AGapThatGrowsIsSaidToGrow) {
  Merit merit = earned();
  merit.share = merit.share_of_first = -0.4;
  EXPECT_EQ(lack(merit), "the squared gap on held-out data does not fall with it");
}

TEST(Merit, FaintGapsAskForMore) {
  Merit merit = earned();
  merit.significance = 5.0;
  EXPECT_EQ(lack(merit), "");
  merit.only_faint_gaps = true;
  EXPECT_NE(lack(merit), "");
}

TEST(Merit, WhatIsSmallBesideTheFirstGapMustBeMoreCertain) {
  Merit merit = earned();
  merit.share_of_first = 0.02;
  EXPECT_NE(lack(merit).find("2.0 % of what the squared gap was at first"), std::string::npos);
  merit.significance = 8.5;
  EXPECT_EQ(lack(merit), "");
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
