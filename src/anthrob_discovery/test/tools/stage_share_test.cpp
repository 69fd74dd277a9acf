#include "stage_share.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace discovery {
namespace stage_share_test {

TEST(StageShare, RisesWithEveryStageAndNeverReachesOne) {
  for (const int effects : {0, 1, 3, 20}) {
    EXPECT_EQ(share_of_stages(0, effects), 0.0);
    for (std::size_t done = 1; done < 200; ++done) {
      EXPECT_GT(share_of_stages(done, effects), share_of_stages(done - 1, effects)) << done;
      EXPECT_LT(share_of_stages(done, effects), 1.0) << done;
    }
  }
}

}  // namespace stage_share_test
}  // namespace discovery
}  // namespace anthrob
