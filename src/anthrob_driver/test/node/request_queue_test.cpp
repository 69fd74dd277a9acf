#include "request_queue.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>
#include <vector>

namespace anthrob {
namespace driver {
namespace {

struct Call final : ros::CallbackInterface {
  explicit Call(std::vector<std::uint64_t>& counts_seen) : counts(counts_seen) {}
  CallResult call() override {
    counts.push_back(RequestQueue::received());
    return Success;
  }
  std::vector<std::uint64_t>& counts;
};

TEST(RequestQueue, ACallIsSeenWithTheCountItCameInWith) {
  std::uint64_t stops = 3;
  RequestQueue queue([&] { return stops; });
  std::vector<std::uint64_t> counts;
  queue.addCallback(boost::make_shared<Call>(counts), 1);
  stops = 4;  // while it waits
  queue.addCallback(boost::make_shared<Call>(counts), 2);
  stops = 9;
  queue.callAvailable();
  EXPECT_EQ(counts, (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(RequestQueue::received(), 0u);
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
