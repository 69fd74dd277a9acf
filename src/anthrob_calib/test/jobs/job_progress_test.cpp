// Lines of progress, in whatever pieces they come.
#include "jobs/job_progress.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace jobs {
namespace job_progress_test {

TEST(JobProgress, IsReadByTheByte) {
  ProgressReader reader;
  const std::string text =
      "{\"stage\": \"searching\"}\n{\"share\": 0.25, \"seconds_left\": 12.5}\n"
      "{\"best\": \"a \\\"b\\\"\"}\n{\"error\": \"disk full\"}\n{\"headline\": \"usable\"}\n";
  EXPECT_FALSE(reader.progress().error);
  for (const char c : text) reader.read(std::string(1, c));
  const JobProgress& progress = reader.progress();
  EXPECT_EQ(progress.stage, "searching");
  EXPECT_EQ(progress.share, 0.25);
  EXPECT_EQ(progress.seconds_left, 12.5);
  EXPECT_EQ(progress.best, "a \"b\"");
  EXPECT_EQ(progress.error, "disk full");
  EXPECT_EQ(progress.headline, "usable");
}

TEST(JobProgress, TimeThatIsNotKnownReplacesWhatWas) {
  ProgressReader reader;
  reader.read(
      "{\"share\": 0.25, \"seconds_left\": 12.5}\n{\"share\": 0.5, \"seconds_left\": null}\n");
  EXPECT_EQ(reader.progress().share, 0.5);
  EXPECT_FALSE(reader.progress().seconds_left);
}

TEST(JobProgress, StaysWithinItsRangeAndPassesOverWhatIsTorn) {
  ProgressReader reader;
  reader.read("{\"share\": 7}\n{\"stage\": \"sear\n[1]\n{\"best\": 3}\n{\"stage\": \"scr");
  EXPECT_EQ(reader.progress().share, 1.0);
  EXPECT_EQ(reader.progress().stage, "");
  EXPECT_EQ(reader.progress().best, "");
}

}  // namespace job_progress_test
}  // namespace jobs
}  // namespace anthrob
