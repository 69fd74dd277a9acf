// Links and joints that are no tree: refused with lines and names, before urdfdom follows them.
#include <chrono>

#include "loading/urdf_support.h"

namespace anthrob {
namespace {

using testing_support::arm_and;
using testing_support::arm_with;
using testing_support::expect_refused;
using testing_support::expect_silence;
using testing_support::kArmUrdf;
using testing_support::said_about;

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& type = "fixed") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/></joint>";
}

std::string link(const std::string& name) {
  return "<link name=\"" + name + "\"/>";
}

const char* const kOneParent =
    "; expected one parent: a closed chain is not simulated; is a joint left over, or meant for "
    "another link?";

TEST(UrdfTree, ATreeIsAccepted) {
  expect_silence(kArmUrdf);
  expect_silence(arm_and(link("tool") + joint("mount", "forearm", "tool") + link("pen") +
                         joint("holder", "tool", "pen")));
  expect_silence(arm_and(link("left") + link("right") + joint("l", "base", "left") +
                         joint("r", "base", "right")));
  // Whatever the order in the file.
  expect_silence(arm_and(joint("mount", "forearm", "tool") + link("tool")));
}

TEST(UrdfTree, ALinkWithTwoParents) {
  expect_refused(arm_and(joint("second", "base", "forearm")),
                 std::string("35: link forearm: child of joints elbow and second") + kOneParent);
  // The same parent twice, a joint copied with another name.
  expect_refused(arm_and(joint("elbow_2", "upper_arm", "forearm", "continuous")),
                 std::string("35: link forearm: child of joints elbow and elbow_2") + kOneParent);
  expect_refused(arm_and(link("rod") + joint("p1", "base", "rod") + joint("p2", "rod", "forearm")),
                 std::string("35: link forearm: child of joints elbow and p2") + kOneParent);
  expect_refused(arm_and(joint("a", "base", "forearm") + joint("b", "base", "forearm")),
                 std::string("35: link forearm: child of joints elbow, a and b") + kOneParent);
}

TEST(UrdfTree, ALinkThatHangsOnItself) {
  for (const char* name : {"base", "upper_arm", "forearm"}) {
    expect_refused(
        arm_and(joint("own", name, name)),
        std::string("35: joint own: parent and child are both ") + name + "; expected two links");
  }
}

TEST(UrdfTree, ALoopBelowALinkThatHangsOnAnother) {
  const std::string end = "; expected a tree: are parent and child swapped?";
  expect_refused(arm_and(joint("back", "forearm", "upper_arm")),
                 "35: joint back: closes a loop of links upper_arm and forearm (joints elbow and "
                 "back)" +
                     end);
  expect_refused(
      arm_and(link("tool") + joint("mount", "forearm", "tool") +
              joint("back", "tool", "upper_arm", "continuous")),
      "35: joint back: closes a loop of links upper_arm, forearm and tool (joints elbow, "
      "mount and back)" +
          end);
  expect_refused(
      arm_and(link("tool") + joint("mount", "forearm", "tool") + joint("back", "tool", "forearm")),
      "35: joint back: closes a loop of links forearm and tool (joints mount and back)" + end);
}

TEST(UrdfTree, ALoopThatHangsOnNothing) {
  const std::string end = ", which hangs on no other link; expected a tree: is a parent misspelt?";
  expect_refused(arm_and(link("a") + link("b") + joint("ab", "a", "b") + joint("ba", "b", "a")),
                 "35: joint ba: closes a loop of links a and b (joints ab and ba)" + end);
  // Through the root: nothing is left to hang on.
  expect_refused(arm_and(joint("back", "forearm", "base")),
                 "35: joint back: closes a loop of links base, upper_arm and forearm (joints "
                 "shoulder, elbow and back)" +
                     end);
  // A tail on the loop.
  const std::string tail =
      said_about(arm_and(link("tail") + link("a") + link("b") + joint("t", "b", "tail") +
                         joint("ab", "a", "b") + joint("ba", "b", "a")))
          .refusal.value_or("accepted");
  EXPECT_NE(tail.find("a loop of links "), std::string::npos) << tail;
  EXPECT_EQ(tail.find("tail"), std::string::npos) << tail;
}

TEST(UrdfTree, SeveralRoots) {
  const std::string end = ": children of no joint; expected one root: is a joint missing?";
  expect_refused(arm_and(link("tool")), "35: links base and tool" + end);
  expect_refused(arm_and(link("tool") + link("pen")), "35: links base, tool and pen" + end);
  expect_refused(
      arm_with("  <link name=\"base\"/>\n", "  <link name=\"world\"/>\n  <link name=\"base\"/>\n"),
      "3: links world and base" + end);
}

TEST(UrdfTree, NamesThatAreNotUniqueOrNotThere) {
  expect_refused(arm_and(link("forearm")),
                 "35: link forearm: appears twice; expected each name once, the first is in line "
                 "28");
  expect_refused(arm_and(link("tool") + joint("elbow", "forearm", "tool")),
                 "35: joint elbow: appears twice; expected each name once, the first is in line "
                 "21");
  expect_refused(arm_with("<child link=\"forearm\"/>", "<child link=\"foreram\"/>"),
                 "23: joint elbow: child: foreram: expected the name of a link, as forearm");
  expect_refused(arm_with("<parent link=\"base\"/>", "<parent link=\"pelvis\"/>"),
                 "4: joint shoulder: parent: pelvis: expected the name of a link");
  expect_refused(arm_with("<parent link=\"base\"/>", ""),
                 "3: joint shoulder: parent: missing; expected <parent link=\"...\"/>");
  expect_refused(arm_with("<link name=\"base\"/>", "<link/>"), "2: link: expected name=\"...\"");
}

TEST(UrdfTree, ManyLinksAreLookedAtOnce) {
  std::string more;
  std::string last = "forearm";
  for (int i = 0; i < 3000; ++i) {
    const std::string name = "l" + std::to_string(i);
    more += link(name) + joint("j" + std::to_string(i), last, name);
    last = name;
  }
  const auto start = std::chrono::steady_clock::now();
  const auto refusal = said_about(arm_and(more + joint("back", last, "upper_arm"))).refusal;
  EXPECT_NE(refusal.value_or("accepted").find("joint back: closes a loop of links upper_arm"),
            std::string::npos);
  EXPECT_LT(refusal.value_or("").size(), 400u);  // one line that can be read
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

/// An arm with so many more links one below the other.
std::string arm_with_chain(int length) {
  std::string more, last = "forearm";
  for (int i = 0; i < length; ++i) {
    const std::string name = "l" + std::to_string(i);
    more += link(name) + joint("j" + std::to_string(i), last, name);
    last = name;
  }
  return arm_and(more);
}

TEST(UrdfTree, AChainThatWouldEndTheStackIsRefused) {
  EXPECT_EQ(said_about(arm_with_chain(900)).refusal, std::nullopt);
  for (const int length : {1001, 9000}) {
    const std::string said = said_about(arm_with_chain(length)).refusal.value_or("accepted");
    EXPECT_NE(said.find("the 1001th in a chain; expected at most 1000"), std::string::npos) << said;
  }
  const std::string said = said_about(arm_with_chain(20000)).refusal.value_or("accepted");
  EXPECT_NE(said.find("more than 10000 links"), std::string::npos) << said;
}

}  // namespace
}  // namespace anthrob
