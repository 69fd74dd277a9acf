// Jobs from their start to their result, with a script as the program.
#include "jobs/job.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "anthrob_core/testing/content.h"

namespace anthrob {
namespace jobs {
namespace job_test {

namespace fs = std::filesystem;

class JobTest : public testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::temp_directory_path() / ("anthrob_job_" + std::to_string(getpid()));
    fs::create_directories(top_ / "lib/made");
    const char* const spaces = std::getenv("CMAKE_PREFIX_PATH");
    spaces_ = spaces ? spaces : "";
    setenv("CMAKE_PREFIX_PATH", top_.c_str(), 1);
  }
  void TearDown() override {
    setenv("CMAKE_PREFIX_PATH", spaces_.c_str(), 1);
    fs::remove_all(top_);
  }

  JobCommand program(const std::string& script) {
    const fs::path file = top_ / "lib/made/program";
    std::ofstream(file) << "#!/bin/sh\ncd " << top_.string() << "\n" << script << "\n";
    fs::permissions(file, fs::perms::owner_all);
    return {"made", "program", {"--out", "my folder"}, (top_ / "out").string()};
  }
  static JobResult wait_for(Job& job) {
    for (;;) {
      if (const auto result = job.update()) return *result;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  JobResult run(const std::string& script) {
    Job job(program(script));
    return wait_for(job);
  }

  fs::path top_;
  std::string spaces_;
};

TEST_F(JobTest, ThatSucceedsHasItsHeadlineAndTheFilesThatItWrote) {
  fs::create_directories(top_ / "out");
  std::ofstream(top_ / "out/model.yaml") << "of an earlier run\n";
  fs::last_write_time(top_ / "out/model.yaml",
                      fs::file_time_type::clock::now() - std::chrono::hours(1));
  const JobResult result =
      run("echo '{\"headline\": \"usable\"}' >&3; echo page > out/report.html; echo said");
  EXPECT_TRUE(result.success);
  EXPECT_EQ(result.headline, "usable");
  EXPECT_EQ(result.error, "");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.files, std::vector<std::string>{(top_ / "out/report.html").string()});
  EXPECT_EQ(content(result.log),
            "$ " + (top_ / "lib/made/program").string() + " --out 'my folder'\nsaid\n");
}

TEST_F(JobTest, ThatFailsHandsItsLastLineThrough) {
  const JobResult result = run("echo program: no such file >&2; exit 2");
  EXPECT_FALSE(result.success);
  EXPECT_FALSE(result.interrupted);
  EXPECT_EQ(result.error, "program: no such file");
  EXPECT_EQ(result.headline, result.error);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(run("exit 2").error, "ended with status 2 without saying why");  // not the line before
}

/// A full disk takes the log as well.
TEST_F(JobTest, WhatIsToldBesideTheLogCounts) {
  EXPECT_EQ(run("echo '{\"error\": \"program: out: No space left on device\"}' >&3; exit 1").error,
            "program: out: No space left on device");
}

TEST_F(JobTest, ThatIsKilledNamesTheSignal) {
  const JobResult result = run("echo working >&2; kill -9 $$");
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.error, "killed by signal 9 (Killed)");
  EXPECT_EQ(result.exit_code, 137);
}

TEST_F(JobTest, ThatIsInterruptedOnRequestSaysSo) {
  Job job(
      program("trap 'echo \"{\\\"headline\\\": \\\"so far\\\"}\" >&3; exit 130' INT\n"
              "touch ready; while :; do sleep 0.01; done"));
  while (!fs::exists(top_ / "ready")) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_FALSE(job.update());
  job.interrupt();
  const JobResult result = wait_for(job);
  EXPECT_TRUE(result.interrupted);
  EXPECT_FALSE(result.success);
  EXPECT_EQ(result.headline, "interrupted; the same goal goes on from there; so far");
  // Nobody asked for this one.
  EXPECT_FALSE(run("exit 130").interrupted);
}

TEST_F(JobTest, ThatCannotBeginIsToldAtOnce) {
  const auto complaint = [](const JobCommand& command) {
    try {
      Job job(command);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("started");
  };
  JobCommand command = program("exit 0");
  command.out = "/proc/none";
  EXPECT_EQ(complaint(command).find("/proc/none: cannot be made: "), 0u) << complaint(command);
  command = program("exit 0");
  command.program = "anthrob_nothing";
  EXPECT_EQ(complaint(command).find("anthrob_nothing: not found; expected "), 0u);
  EXPECT_FALSE(fs::exists(command.out)) << "an empty folder stays behind";
}

}  // namespace job_test
}  // namespace jobs
}  // namespace anthrob
