// Quantiles, as tables of statistics have them.
#include "judgement/quantiles.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace discovery {
namespace {

TEST(Quantiles, AreThoseOfTheTables) {
  EXPECT_NEAR(one_sided_deviations(0.95), 1.645, 5e-4);
  EXPECT_NEAR(one_sided_deviations(0.99), 2.326, 5e-4);
  EXPECT_NEAR(two_sided_deviations(0.95), 1.960, 5e-4);
  EXPECT_NEAR(two_sided_deviations(0.99), 2.576, 5e-4);
  EXPECT_NEAR(2.0 * rise_at_ends(0.95), 3.841, 5e-4);
  EXPECT_NEAR(2.0 * rise_at_ends(0.99), 6.635, 5e-4);
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
