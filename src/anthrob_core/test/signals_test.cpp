// How a program ends that is stopped: with the status that the documents promise.
#include "anthrob_core/signals.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <initializer_list>

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
  const auto stopped = [](std::initializer_list<int> numbers) {
    return status_of([&] {
      return run_tool([&] {
        const bool before = tool::interrupted();
        for (const int number : numbers) raise(number);
        return tool::interrupted() && !before ? 40 : 1;
      });
    });
  };
  for (const int number : kStops) EXPECT_EQ(stopped({number}), 40) << number;
  EXPECT_EQ(stopped({SIGINT, SIGTERM}), 40);
  // A closed terminal says so twice; who presses Ctrl-C twice is in a hurry.
  EXPECT_EQ(stopped({SIGHUP, SIGHUP}), 40);
  EXPECT_EQ(stopped({SIGINT, SIGINT}), 130);
  EXPECT_EQ(stopped({SIGTERM, SIGTERM}), 130);
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
