#include "timed_calls.h"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

namespace anthrob {
namespace {

std::vector<CallResult> wait_for_one(TimedCalls& calls) {
  for (int i = 0; i < 1000; ++i) {
    auto results = calls.finished(0.0);
    if (!results.empty()) return results;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {};
}

TEST(TimedCalls, AnAnswerComesOnce) {
  TimedCalls calls;
  EXPECT_TRUE(calls.start(
      "enable",
      [] {
        return CallResult{"enable", true, "6 units"};
      },
      5.0, 0.0));
  const auto results = wait_for_one(calls);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_TRUE(results[0].success);
  EXPECT_EQ(results[0].message, "6 units");
  EXPECT_TRUE(calls.finished(9.0).empty());
}

TEST(TimedCalls, ACallThatHangsIsGivenUp) {
  TimedCalls calls;
  const auto end = std::make_shared<std::promise<void>>();
  const std::shared_future<void> ended = end->get_future().share();
  const auto hang = [ended] {
    ended.wait();
    return CallResult{"disable", true, "late"};
  };
  EXPECT_TRUE(calls.start("disable", hang, 1.0, 0.0));
  EXPECT_FALSE(calls.start("disable", hang, 1.0, 0.5));  // one at a time
  EXPECT_TRUE(calls.finished(0.9).empty());
  const auto results = calls.finished(1.0);
  ASSERT_EQ(results.size(), 1U);
  EXPECT_FALSE(results[0].success);
  EXPECT_EQ(results[0].message, "no answer within 1 s");
  EXPECT_TRUE(calls.start("disable", hang, 1.0, 2.0));  // and again
  end->set_value();
  EXPECT_TRUE(wait_for_one(calls)[0].success);
}

TEST(TimedCalls, AnExceptionIsAFailure) {
  TimedCalls calls;
  calls.start(
      "home", []() -> CallResult { throw std::runtime_error("no such"); }, 5.0, 0.0);
  EXPECT_EQ(wait_for_one(calls).at(0).message, "no such");
}

}  // namespace
}  // namespace anthrob
