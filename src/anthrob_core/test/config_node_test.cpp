// ConfigNode: what it refuses and tolerates beyond the files of robots, which bad_files_test of
// anthrob_sim covers.
#include "anthrob_core/config_node.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"

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

TEST(ConfigNode, RefusesWhatYamlReadsOtherwiseThanItSeems) {
  EXPECT_EQ(refusal("usual: &u {static: 1}\nelbow:\n  <<: *u\n"),
            "file.yaml:3: <<: merge keys are not read; expected extends, or the keys again");
  EXPECT_EQ(refusal("coil: {type: linear, stiffness: 1500,0}"),
            "file.yaml:1: stiffness: 1500,0: a decimal comma? expected 1500.0");
  EXPECT_EQ(refusal("time: {column: t, scale: 0,001}"),
            "file.yaml:1: scale: 0,001: a decimal comma? expected 0.001");
  EXPECT_EQ(refusal("y: {offset: -0,5, scale: 2}"),
            "file.yaml:1: offset: -0,5: a decimal comma? expected -0.5");
  // Maps that are meant so.
  EXPECT_EQ(refusal("{1: 2, 3: 4}"), "");
  EXPECT_EQ(refusal("{a: word, 7: }"), "");
}

TEST(ConfigNode, RefusesWhatComesAfterTheOnlyDocument) {
  EXPECT_EQ(refusal("a: 1\n---\nb: 2\n"), "file.yaml:2: a second document: expected one");
  // yaml-cpp would find one document after the other, without end.
  for (const char* text : {", a: 1\n", "[1], 2\n", ",", "x, [1]: {,\n"}) {
    EXPECT_NE(refusal(text), "") << text;
  }
  EXPECT_EQ(refusal("[1, 2],\n3\n"), "file.yaml:1: not valid YAML: a comma outside of all lists");
}

TEST(ConfigNode, SaysInOneLineWhatKeysOfManyLinesAre) {
  const std::string text = "\"a key\\nof two lines\": {b: 1}\n";
  EXPECT_EQ(refusal(text,
                    [](const ConfigNode& root) {
                      root.entries().front().second.number("c", Bounds::any(), "m");
                    })
                .find('\n'),
            std::string::npos);
}

TEST(ConfigNode, RefusesAnAliasInsideItsOwnAnchor) {
  for (const char* text : {"a: &x {b: *x}\n", "a: &x [*x, *x]\n", "&x {a: *x}\n"}) {
    EXPECT_NE(refusal(text).find("nested more than 100 deep"), std::string::npos) << text;
  }
}

TEST(ConfigNode, RefusesWhatHasNoEnd) {
  // Each list holds the one before nine times: 9^12 values.
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string before = "*a" + std::to_string(i - 1), own = "a" + std::to_string(i);
    bomb += own + ": &" + own + " [" + before;
    for (int k = 1; k < 9; ++k) bomb += ", " + before;
    bomb += "]\n";
  }
  EXPECT_NE(refusal(bomb).find("more than 1000000 values"), std::string::npos);
  // Nor has what it says of a name.
  const std::string name(5000000, 'k');
  EXPECT_LT(refusal("{\"" + name + "\": 1, \"" + name + "\": 2}").size(), 3000u);
}

TEST(ConfigNode, RefusesFilesWithoutEnd) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_endless_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  for (int i = 0; i < 30; ++i) {
    const std::string next = "f" + std::to_string(i + 1) + ".yaml";
    std::ofstream(folder / ("f" + std::to_string(i) + ".yaml"))
        << "extends: [" << next << ", " << next << "]\n";
  }
  std::ofstream(folder / "f30.yaml") << "a: 1\n";
  const auto said = [](const std::string& file) -> std::string {
    try {
      ConfigNode::load(file);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(said((folder / "f0.yaml").string()).find("extends: more than 100 files in all"),
            std::string::npos);
  EXPECT_EQ(said((folder / "f29.yaml").string()), "");
  EXPECT_EQ(said("/dev/zero"), "/dev/zero: expected a YAML file");
  fs::remove_all(folder);
}

TEST(ConfigNode, RefusesEmptyValuesWhereTheyAreMistakes) {
  const auto check = [](const ConfigNode& root) { root.refuse_empty_values(); };
  EXPECT_EQ(refusal("a: 1\nb: {c: 2, d: }\n", check),
            "file.yaml:2: b.d: (empty): expected a value; otherwise leave the key out");
  EXPECT_EQ(refusal("a:\n  - {b: ~}\n", check),
            "file.yaml:2: a.0.b: (empty): expected a value; otherwise leave the key out");
  EXPECT_EQ(refusal("a: 1\nb: ''\n", check), "");
}

TEST(ConfigNode, RemovesOnlyWhatTheExtendedFileHas) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_config_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "base.yaml") << "muscles: {flexor: {length: 1}, extensor: {length: 2}}\n";
  const auto said = [&](const std::string& text) -> std::string {
    std::ofstream(folder / "over.yaml") << "extends: base.yaml\n" << text;
    try {
      const ConfigNode muscles = ConfigNode::load((folder / "over.yaml").string()).at("muscles");
      return muscles.has("flexor") ? "kept" : "removed";
    } catch (const BadInput& error) {
      return fs::path(error.what()).filename().string();
    }
  };
  EXPECT_EQ(said("muscles: {flexor: null}\n"), "removed");
  EXPECT_EQ(said("muscles: {extensor: null}\n"), "kept");
  const std::string unknown =
      ": unknown key; without a value it removes one of the file that is "
      "extended";
  EXPECT_EQ(said("muscles: {flexr: null}\n"), "over.yaml:2: muscles.flexr" + unknown);
  EXPECT_EQ(said("muscles:\n  flexor: {lenght: }\n"),
            "over.yaml:3: muscles.flexor.lenght" + unknown);
  EXPECT_EQ(said("musclse: null\n"), "over.yaml:2: musclse" + unknown);
  fs::remove_all(folder);
}

TEST(ConfigNode, SaysWhichFileMakesAKeyUnknown) {
  namespace fs = std::filesystem;
  const fs::path folder =
      fs::temp_directory_path() / ("anthrob_config_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "base.yaml") << "gear: {law: a, steepness: 1}\n";
  std::ofstream(folder / "over.yaml") << "extends: base.yaml\n\ngear: {law: b}\n";
  const ConfigNode root = ConfigNode::load((folder / "over.yaml").string());
  root.at("gear").at("law").as_text();
  try {
    root.refuse_unknown_keys();
    FAIL() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder / "base.yaml:1: gear.steepness: unknown key, with what ").string() +
                  (folder / "over.yaml:3 sets; there, 'steepness: null' removes it").string());
  }
  fs::remove_all(folder);
}

TEST(ConfigNode, TakesNoLeadingZeroForOctal) {
  const auto read = [](const ConfigNode& root) { root.at("a").as_integer(0, 20); };
  EXPECT_EQ(refusal("a: 10\n", read), "");
  EXPECT_EQ(refusal("a: 0\n", read), "");
  EXPECT_EQ(refusal("a: 010\n", read),
            "file.yaml:1: a: 010: expected an integer from 0 to 20, without a leading 0");
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
