#include "anthrob_driver/realtime.h"

#include <pthread.h>
#include <sys/mman.h>

#include <cerrno>
#include <cstring>

namespace anthrob {
namespace driver {

std::optional<std::string> become_realtime(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (error != 0) {
    return "no SCHED_FIFO: " + std::string(std::strerror(error)) +
           "; run as root or set rtprio in /etc/security/limits.conf";
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    return "memory is not locked: " + std::string(std::strerror(errno)) +
           "; run as root or set memlock in /etc/security/limits.conf";
  }
  return std::nullopt;
}

}  // namespace driver
}  // namespace anthrob
