#include "command_thread.h"

#include <gtest/gtest.h>

#include <atomic>

#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace {

void sleep_for(double time) {
  std::this_thread::sleep_for(std::chrono::duration<double>(time));
}

TEST(CommandThread, RepeatsWhileItsOwnerIsBusyAndEndsIfItHangs) {
  std::atomic<int> sent{0};
  CommandThread thread([&](const std::vector<Reference>&) { ++sent; });
  thread.set({{"flexor", ControlMode::kForce, 5.0}}, monotonic_now() + 0.5);
  sleep_for(1.0);
  EXPECT_GE(sent, 6);
  EXPECT_LE(sent, 11);
  sent = 0;
  sleep_for(0.2);
  EXPECT_EQ(sent, 0);
}

TEST(CommandThread, SendsNothingOnceItWasTold) {
  std::atomic<int> sent{0};
  CommandThread thread([&](const std::vector<Reference>&) { ++sent; });
  thread.set({{"flexor", ControlMode::kForce, 5.0}}, monotonic_now() + 9.0);
  sleep_for(0.3);
  thread.set({}, 0.0);
  EXPECT_GE(sent, 2);
  sent = 0;
  sleep_for(0.2);
  EXPECT_EQ(sent, 0);
}

}  // namespace
}  // namespace anthrob
