#include "request_queue.h"

#include <boost/make_shared.hpp>

namespace anthrob {
namespace driver {

namespace {

thread_local std::uint64_t count_of_this_call = 0;

/// A call and the count it came in with.
class Counted final : public ros::CallbackInterface {
 public:
  Counted(const ros::CallbackInterfacePtr& call, std::uint64_t count)
      : call_(call), count_(count) {}

  CallResult call() override {
    count_of_this_call = count_;
    const CallResult result = call_->call();
    count_of_this_call = 0;
    return result;
  }
  bool ready() override { return call_->ready(); }

 private:
  ros::CallbackInterfacePtr call_;
  std::uint64_t count_;
};

}  // namespace

void RequestQueue::addCallback(const ros::CallbackInterfacePtr& call, std::uint64_t owner) {
  ros::CallbackQueue::addCallback(boost::make_shared<Counted>(call, count_()), owner);
}

std::uint64_t RequestQueue::received() {
  return count_of_this_call;
}

}  // namespace driver
}  // namespace anthrob
