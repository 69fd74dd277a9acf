// ConfigNode: what it refuses and tolerates beyond the files of robots, which bad_files_test of
// anthrob_sim covers.
#include "anthrob_config/config_node.h"

#include <gtest/gtest.h>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace {

/// What is said about a text; empty if it is accepted.
template <typename Read>
std::string refusal(const std::string& text, Read read) {
  try {
    read(ConfigNode::parse(text, "file.yaml"));
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

std::string refusal(const std::string& text) {
  return refusal(text, [](const ConfigNode&) {});
}

TEST(ConfigNode, TakesTheHeaderOfOpenCv) {
  const ConfigNode node = ConfigNode::parse("%YAML:1.0\n---\nkey: 3\n", "file.yaml");
  EXPECT_EQ(node.number("key", Bounds::any(), "1"), 3.0);
  EXPECT_EQ(refusal("%YAML:1.0\n---\nkey: x\n",
                    [](const ConfigNode& root) { root.number("key", Bounds::any(), "m"); }),
            "file.yaml:3: key: x: expected a finite number [m]");
}

TEST(ConfigNode, RefusesKeysThatAreNoWords) {
  EXPECT_EQ(refusal("a: 1\n? [b, c]\n: 2\n"),
            "file.yaml:2: a key that is no word: expected KEY: VALUE");
  EXPECT_NE(refusal("a: 1\n'': 2\n").find("a key that is no word"), std::string::npos);
}

TEST(ConfigNode, RefusesAnAliasInsideItsOwnAnchor) {
  for (const char* text : {"a: &x {b: *x}\n", "a: &x [*x, *x]\n", "&x {a: *x}\n"}) {
    EXPECT_NE(refusal(text).find("nested more than 100 deep"), std::string::npos) << text;
  }
}

TEST(ConfigNode, RefusesEmptyValuesWhereTheyAreMistakes) {
  const auto check = [](const ConfigNode& root) { root.refuse_empty_values(); };
  EXPECT_EQ(refusal("a: 1\nb: {c: 2, d: }\n", check),
            "file.yaml:2: b.d: (empty): expected a value; otherwise leave the key out");
  EXPECT_EQ(refusal("a:\n  - {b: ~}\n", check),
            "file.yaml:2: a.0.b: (empty): expected a value; otherwise leave the key out");
  EXPECT_EQ(refusal("a: 1\nb: ''\n", check), "");
}

TEST(ConfigNode, ReadsListsOfSoManyNumbers) {
  const auto read = [](const ConfigNode& root) { root.at("a").as_numbers(2, "m"); };
  EXPECT_EQ(refusal("a: [1, 2]\n", read), "");
  EXPECT_EQ(refusal("a: [1, 2, 3]\n", read), "file.yaml:1: a: a list of 3: expected 2 numbers [m]");
  EXPECT_EQ(refusal("a: 1\n", read), "file.yaml:1: a: 1: expected 2 numbers [m]");
  EXPECT_EQ(refusal("a: [1, .nan]\n", read),
            "file.yaml:1: a.1: .nan: expected a finite number [m]");
}

}  // namespace
}  // namespace anthrob
