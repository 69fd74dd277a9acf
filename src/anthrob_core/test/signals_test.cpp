// How a program ends that is stopped: with the status that the documents promise.
#include "anthrob_core/signals.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <initializer_list>
#include <thread>

#include "anthrob_core/command_line.h"

namespace anthrob {
namespace {

const std::initializer_list<int> kStops = {SIGINT, SIGTERM, SIGHUP};

/// Of a process of its own; -1 if a signal killed it.
int status_of(const std::function<int()>& program) {
  const pid_t child = fork();
  if (child == 0) _exit(program());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int run_tool(const std::function<int()>& body) {
  CLI::App app("a tool");
  char name[] = "tool";
  char* arguments[] = {name};
  return tool::run(app, 1, arguments, body);
}

TEST(Signals, WhatHasNothingToKeepLeavesAtOnce) {
  for (const int number : kStops) {
    EXPECT_EQ(status_of([&] { return leave_when_stopped(7), raise(number), 1; }), 7) << number;
    EXPECT_EQ(status_of([&] { return run_tool([&] { return raise(number), 1; }); }), 130) << number;
  }
}

TEST(Signals, AToolThatListensComesToItsEnd) {
  const auto stopped = [](std::initializer_list<int> numbers, double apart = 0.0) {
    return status_of([&] {
      return run_tool([&] {
        const bool before = tool::interrupted();
        for (const int number : numbers) {
          raise(number);
          std::this_thread::sleep_for(std::chrono::duration<double>(apart));
        }
        return tool::interrupted() && !before ? 40 : 1;
      });
    });
  };
  for (const int number : kStops) EXPECT_EQ(stopped({number}), 40) << number;
  EXPECT_EQ(stopped({SIGINT, SIGTERM}), 40);
  // timeout and a closed terminal say so twice; who presses Ctrl-C again later is in a hurry.
  for (const int number : kStops) {
    EXPECT_EQ(stopped({number, number}), 40) << number;
    EXPECT_EQ(stopped({number, number}, 0.6), 130) << number;
  }
}

TEST(Signals, NohupKeepsAClosedTerminalAway) {
  EXPECT_EQ(status_of([] {
              signal(SIGHUP, SIG_IGN);
              return run_tool([] {
                raise(SIGHUP);
                const bool heard = tool::interrupted();
                raise(SIGHUP);
                return heard || tool::interrupted() ? 1 : 41;
              });
            }),
            41);
}

}  // namespace
}  // namespace anthrob
