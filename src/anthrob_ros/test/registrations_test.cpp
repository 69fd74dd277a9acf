#include "registrations.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

XmlRpc::XmlRpcValue entry(const std::string& name, const std::string& first,
                          const std::string& second = "/other") {
  XmlRpc::XmlRpcValue result;
  result[0] = name;
  result[1][0] = first;
  result[1][1] = second;
  return result;
}

/// As of getSystemState.
XmlRpc::XmlRpcValue state() {
  XmlRpc::XmlRpcValue result;
  result[0][0] = entry("/states", "/node");
  result[0][1] = entry("/tf", "/third", "/node");
  result[0][2] = entry("/clock", "/third");
  result[1][0] = entry("/command", "/node");
  result[2][0] = entry("/stop", "/node");
  result[2][1] = entry("/enable", "/node2");
  return result;
}

TEST(Registrations, AreThoseOfTheNode) {
  const auto found = registrations_of("/node", state());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->published, (std::set<std::string>{"/states", "/tf"}));
  EXPECT_EQ(found->subscribed, (std::set<std::string>{"/command"}));
  EXPECT_EQ(found->services, (std::set<std::string>{"/stop"}));
  EXPECT_EQ(registrations_of("/nobody", state())->size(), 0u);
}

TEST(Registrations, OfAnAnswerOfAnotherFormAreNone) {
  EXPECT_FALSE(registrations_of("/node", XmlRpc::XmlRpcValue(3)));
  XmlRpc::XmlRpcValue numbers = state();
  numbers[1][0] = 7;
  EXPECT_FALSE(registrations_of("/node", numbers));
}

TEST(Registrations, PublishersAreThoseOfTheTopics) {
  const PublishersByTopic found = publishers_for({"/tf", "/nothing"}, state());
  EXPECT_EQ(found, (PublishersByTopic{{"/tf", {"/third", "/node"}}}));
  EXPECT_TRUE(publishers_for({"/tf"}, XmlRpc::XmlRpcValue(3)).empty());
}

TEST(Registrations, WhatIsMissingIsNamed) {
  const Registrations expected = *registrations_of("/node", state());
  Registrations known = expected;
  EXPECT_EQ(expected.without(known).size(), 0u);
  known.services.clear();
  EXPECT_EQ(expected.without(known).text(), "/stop");
  EXPECT_EQ(expected.without({}).text(), "/command and 3 more");
}

TEST(Registrations, PayloadNeedsAnAnswerThatSaysYes) {
  Reply reply;
  for (int i = 0; i < 3; ++i) reply.value[i] = i;
  reply.value[0] = 1;
  EXPECT_FALSE(payload_of(reply)) << "silent";
  reply.reach = Reach::kAnswered;
  ASSERT_TRUE(payload_of(reply));
  reply.value[0] = 0;
  EXPECT_FALSE(payload_of(reply)) << "refused";
  reply.value = XmlRpc::XmlRpcValue("what?");
  EXPECT_FALSE(payload_of(reply));
}

}  // namespace
}  // namespace anthrob
