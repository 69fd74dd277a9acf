#include "anthrob_ros/run_node.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "anthrob_core/version.h"
#include "anthrob_ros/master_uri.h"

namespace anthrob {
namespace {

NodeInfo simulator() {
  NodeInfo info;
  info.name = "simulator";
  info.purpose = "A robot.";
  info.parameters = {{"model", "path"}, {"state_rate", "[Hz]; 500"}};
  return info;
}

TEST(RunNode, ArgumentsOfRosPass) {
  EXPECT_EQ(wrong_argument(simulator(), {}), std::nullopt);
  EXPECT_EQ(wrong_argument(simulator(), {"__name:=a", "__ns:=b", "/muscle_states:=/c",
                                         "_model:=d.yaml", "_state_rate:=250"}),
            std::nullopt);
}

TEST(RunNode, MisspeltParameterIsTold) {
  EXPECT_EQ(wrong_argument(simulator(), {"_model:=d.yaml", "_rate:=2"}),
            "parameter ~rate: unknown; expected one of ~model, ~state_rate");
}

TEST(RunNode, ArgumentThatRosWouldPassOverIsTold) {
  for (const char* argument : {"--rate", "model.yaml", "", "_model=d.yaml"}) {
    EXPECT_EQ(wrong_argument(simulator(), {argument}),
              std::string("argument '") + argument +
                  "': expected _PARAMETER:=VALUE, --help or --version");
  }
}

TEST(RunNode, HelpTellsEveryParameter) {
  EXPECT_EQ(help_of(simulator(), "/opt/lib/anthrob_simulator"),
            "A robot.\n"
            "Usage: anthrob_simulator _PARAMETER:=VALUE ... [__ns:=ROBOT] [__name:=NAME]\n\n"
            "Parameters:\n"
            "  _model       path\n"
            "  _state_rate  [Hz]; 500\n");
}

/// Before ros::init: no master is wanted.
TEST(RunNode, AnswersWithoutMaster) {
  const NodeBody body = [](ros::NodeHandle&, ros::NodeHandle&) { return 77; };
  char program[] = "program", help[] = "--help", wrong[] = "--rate";
  char* asked[] = {program, help};
  EXPECT_EQ(run_node(2, asked, simulator(), body), 0);
  char version[] = "--version";
  char* of_what[] = {program, version};
  testing::internal::CaptureStdout();
  EXPECT_EQ(run_node(2, of_what, simulator(), body), 0);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), version_of("program") + "\n");
  char* mistaken[] = {program, wrong};
  EXPECT_EQ(run_node(2, mistaken, simulator(), body), 2);
}

TEST(RunNode, AMasterHasAnAddress) {
  const auto refused = [](const std::string& uri) {
    setenv("ROS_MASTER_URI", uri.c_str(), 1);
    return wrong_master_uri({"__name:=a"});
  };
  for (const char* uri : {"http://localhost:11311", "http://localhost:11311/", "http://10.0.0.7:1",
                          "http://robot.lab:65535"}) {
    EXPECT_EQ(refused(uri), std::nullopt) << uri;
  }
  for (const std::string uri :
       {"", "localhost:11311", "http://localhost", "https://localhost:11311", "http://:11311",
        "http://localhost:", "http://localhost:eleven", "http://localhost:0",
        "http://localhost:65536", "http://localhost:11311x", " http://localhost:11311",
        "http://local host:11311", "http://localhost:11311\n", "http://[::1]:11311"}) {
    EXPECT_EQ(refused(uri), "ROS_MASTER_URI: '" + uri +
                                "': expected http://HOST:PORT, such as http://localhost:11311");
  }
  EXPECT_EQ(wrong_master_uri({"__master:=http://localhost:11311"}), std::nullopt);
  unsetenv("ROS_MASTER_URI");
  EXPECT_EQ(wrong_master_uri({"__master:=http://localhost:11311"}), std::nullopt);
  EXPECT_EQ(wrong_master_uri({}).value().find("ROS_MASTER_URI: not set; expected"), 0u);
  EXPECT_EQ(wrong_master_uri({"__master:=localhost"}).value().find("__master: 'localhost': "), 0u);
}

/// Of a node that is stopped while it waits for a master. @return its exit status; -1 if it was
/// killed
int status_of_stopped(int number, bool ends_by_itself) {
  int said[2];
  EXPECT_EQ(pipe(said), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(said[1], STDERR_FILENO);
    setenv("ROS_MASTER_URI", "http://localhost:1", 1);  // nobody listens there
    NodeInfo info = simulator();
    info.ends_by_itself = ends_by_itself;
    char program[] = "program";
    char* arguments[] = {program};
    _exit(run_node(1, arguments, info, [](ros::NodeHandle&, ros::NodeHandle&) { return 77; }));
  }
  close(said[1]);
  std::string text;
  char buffer[256];
  while (text.find("Failed to contact master") == std::string::npos) {
    const ssize_t got = ::read(said[0], buffer, sizeof(buffer));
    if (got <= 0) break;
    text.append(buffer, static_cast<std::size_t>(got));
  }
  kill(child, number);
  int status = 0;
  waitpid(child, &status, 0);
  close(said[0]);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(RunNode, WhatWaitsForAMasterCanBeStopped) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EQ(status_of_stopped(number, false), 0) << number;
    EXPECT_EQ(status_of_stopped(number, true), 130) << number;
  }
}

}  // namespace
}  // namespace anthrob
