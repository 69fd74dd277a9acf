// A child is on its own: no input, no files of ours, its own group, and it does not outlive us
// unseen.
#include "jobs/child_process.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "anthrob_core/testing/content.h"

namespace anthrob {
namespace jobs {
namespace child_process_test {

namespace fs = std::filesystem;

/// In pieces: a shell acts on a signal when what it waits for has ended.
const std::string kForEver = "while :; do sleep 0.01; done";

class ChildProcessTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("anthrob_child_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::vector<std::string> shell(const std::string& script) const {
    return {"/bin/sh", "-c", "cd " + folder_.string() + "; " + script};
  }
  static ProcessEnd wait_for(ChildProcess& child) {
    for (;;) {
      if (const auto end = child.end()) return *end;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  static void wait_for_file(const std::string& file) {
    while (!fs::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }

  fs::path folder_;
};

TEST_F(ChildProcessTest, WhatItSaysGoesToItsPlaces) {
  std::ofstream(path("log")) << "earlier\n";
  ChildProcess child(shell("echo out; echo err >&2; echo told >&$ANTHROB_PROGRESS_FD; "
                           "read line || echo no input; exit 3"),
                     path("log"));
  const ProcessEnd end = wait_for(child);
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_FALSE(end.signal);
  EXPECT_EQ(child.read_progress(), "told\n");
  EXPECT_EQ(content(path("log")), "earlier\nout\nerr\nno input\n");
}

TEST_F(ChildProcessTest, ItGivesWayAndHasNoFilesOfOurs) {
  std::ofstream ours(path("ours"));
  const int own = getpriority(PRIO_PROCESS, 0);
  ChildProcess child(shell("nice; ls /proc/$$/fd"), path("log"));
  EXPECT_EQ(wait_for(child).exit_code, 0);
  std::ifstream log(path("log"));
  int niceness = 0;
  log >> niceness;
  EXPECT_EQ(niceness, std::min(19, own + ChildProcess::kNiceness));
  int count = 0;
  for (int descriptor = 0; log >> descriptor; ++count)
    EXPECT_TRUE(descriptor < 4 || descriptor == 10);
  EXPECT_GE(count, 4);  // dash opens 10 for itself where it reads a script
}

/// Sessions share the processor first, on kernels that group them.
TEST_F(ChildProcessTest, ItsSessionGivesWay) {
  if (!fs::exists("/proc/self/autogroup")) GTEST_SKIP() << "this kernel has no groups";
  ChildProcess child(shell("cat /proc/$$/autogroup"), path("log"));
  EXPECT_EQ(wait_for(child).exit_code, 0);
  EXPECT_NE(content(path("log")).find("nice 10"), std::string::npos) << content(path("log"));
}

TEST_F(ChildProcessTest, ItsGroupIsInterruptedAndOursIsNot) {
  ChildProcess child(
      shell("sh -c 'trap \"touch kept; exit 1\" INT; touch ready; " + kForEver + "'; exit 7"),
      path("log"));
  wait_for_file(path("ready"));
  EXPECT_EQ(getpgid(child.pid()), child.pid());
  child.interrupt();
  EXPECT_EQ(wait_for(child).exit_code, 130);  // its own shell, which traps nothing
  EXPECT_TRUE(fs::exists(path("kept")));      // what that started
}

TEST_F(ChildProcessTest, ASignalThatKillsItIsNamed) {
  ChildProcess child(shell("kill -9 $$"), path("log"));
  const ProcessEnd end = wait_for(child);
  EXPECT_EQ(end.signal, SIGKILL);
  EXPECT_EQ(end.exit_code, 128 + SIGKILL);
}

TEST_F(ChildProcessTest, WhatCannotBeStartedIsToldAtOnce) {
  std::ofstream(path("text")) << "no program\n";
  const auto complaint = [&](const std::string& program, const std::string& log) {
    try {
      ChildProcess child({program}, log);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("started");
  };
  EXPECT_EQ(complaint(path("text"), path("log")),
            path("text") + ": cannot be started: Permission denied");
  EXPECT_EQ(complaint(path("none"), path("log")),
            path("none") + ": cannot be started: No such file or directory");
  EXPECT_EQ(complaint("/bin/true", path("no/log")), path("no/log") + ": No such file or directory");
}

TEST_F(ChildProcessTest, ItIsInterruptedWhenWeAreKilled) {
  const pid_t killed = fork();
  if (killed == 0) {
    ChildProcess child(shell("trap 'touch kept; exit 130' INT; touch ready; " + kForEver),
                       path("log"));
    wait_for_file(path("ready"));
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(killed, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  wait_for_file(path("kept"));
}

}  // namespace child_process_test
}  // namespace jobs
}  // namespace anthrob
