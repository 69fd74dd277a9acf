#include "anthrob_ros/run_node.h"

#include <gtest/gtest.h>

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
              std::string("argument '") + argument + "': expected _PARAMETER:=VALUE, or --help");
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
  char* mistaken[] = {program, wrong};
  EXPECT_EQ(run_node(2, mistaken, simulator(), body), 2);
}

}  // namespace
}  // namespace anthrob
