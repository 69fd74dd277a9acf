#include "anthrob_core/signals.h"

#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace anthrob {

namespace {

volatile sig_atomic_t status_if_stopped = 0;

void leave(int) {
  _exit(status_if_stopped);
}

bool is_ignored(int number) {
  struct sigaction now;
  return sigaction(number, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

void on_stop(void (*handler)(int)) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    // A shell ignores Ctrl-C for what it starts in the background; who sends it all the same means
    // it.
    if (number == SIGHUP && is_ignored(number)) continue;
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;
    sigaction(number, &action, nullptr);
  }
}

void leave_when_stopped(int status) {
  status_if_stopped = status;
  on_stop(leave);
}

}  // namespace anthrob
