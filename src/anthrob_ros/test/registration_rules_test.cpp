#include "registration_rules.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(RegistrationRules, AreQuietWhileRegistered) {
  RegistrationRules rules(0.0);
  for (int i = 1; i < 100; ++i) EXPECT_FALSE(rules.see(Look::kRegistered, i));
}

TEST(RegistrationRules, OneLookIsEnoughIfTheMasterIsGoneOrAnswersWithoutUs) {
  for (const Look look : {Look::kGone, Look::kIncomplete}) {
    RegistrationRules rules(0.0);
    EXPECT_EQ(rules.see(look, 1.0), Turn::kLost);
    EXPECT_FALSE(rules.see(look, 2.0)) << "said once";
    EXPECT_FALSE(rules.see(Look::kSilent, 3.0));
    EXPECT_EQ(rules.see(Look::kRegistered, 4.0), Turn::kRegained);
    EXPECT_FALSE(rules.see(Look::kRegistered, 5.0));
    EXPECT_EQ(rules.see(look, 6.0), Turn::kLost) << "again";
  }
}

TEST(RegistrationRules, ASlowMasterHasTenSeconds) {
  RegistrationRules rules(0.0);
  EXPECT_FALSE(rules.see(Look::kRegistered, 1.0));
  EXPECT_FALSE(rules.see(Look::kSilent, 7.0));
  EXPECT_FALSE(rules.see(Look::kSilent, 10.9));
  EXPECT_FALSE(rules.see(Look::kRegistered, 12.0));
  EXPECT_FALSE(rules.see(Look::kSilent, 18.0));
  EXPECT_EQ(rules.see(Look::kSilent, 22.0), Turn::kLost);
  EXPECT_FALSE(rules.see(Look::kIncomplete, 23.0));
  EXPECT_EQ(rules.see(Look::kRegistered, 23.1), Turn::kRegained);
}

}  // namespace
}  // namespace anthrob
