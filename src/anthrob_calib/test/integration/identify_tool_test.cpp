// anthrob_identify as a user sees it: files that can be pasted, and one clear line for bad input.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "anthrob_core/testing/content.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/spring/series_elastic_element.h"
#include "integration/tool_outcome.h"
#include "virtual_rig/eyelet_pull.h"
#include "virtual_rig/load_resistor.h"
#include "virtual_rig/ring_stretcher.h"

namespace anthrob {
namespace {

namespace fs = std::filesystem;
using testing_support::Outcome;

const std::string kConfig = ANTHROB_CONFIG_DIR;

/// One folder for all tests: recordings are made once.
class IdentifyTool : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    root_ = fs::temp_directory_path() / ("anthrob_identify_" + std::to_string(getpid()));
    const std::string stretcher = kConfig + "/rig_oring_stretcher";
    const auto ring = virtual_rig::RingTruth::load(stretcher, "10x5", 2);
    virtual_rig::StretchOptions stretch;
    stretch.levels = 4;
    virtual_rig::stretch_ring(stretcher, ring, stretch).save(path("ring_1"));
    stretch.specimen = 2;
    virtual_rig::stretch_ring(stretcher, ring, stretch).save(path("ring_2"));
    for (const double load : {21.2, 67.5}) {
      for (const bool pulling : {true, false}) {
        virtual_rig::PullOptions pull;
        pull.load = load;
        pull.pulling = pulling;
        virtual_rig::pull_over_eyelet(kConfig + "/rig_eyelet_pull", pull)
            .save(path("eyelet_" + std::to_string(load > 50.0) + std::to_string(pulling)));
      }
    }
    for (const double load : {0.33, 0.66}) {
      virtual_rig::EcuLoadOptions options;
      options.load_resistance = load;
      virtual_rig::load_ecu(kConfig + "/rig_ecu_load", options)
          .save(path(load < 0.5 ? "ecu_1" : "ecu_2"));
    }
  }
  static void TearDownTestSuite() { fs::remove_all(root_); }

  static std::string path(const std::string& name) { return (root_ / name).string(); }

  static Outcome identify(const std::string& arguments) {
    const std::string errors = path("errors.txt");
    const int status = std::system(
        (std::string(ANTHROB_IDENTIFY) + " " + arguments + " >/dev/null 2>" + errors).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(errors)};
  }

  /// A copy of a recording with one of its files changed.
  static std::string altered(const std::string& from, const std::string& file,
                             const std::function<std::string(std::string)>& change,
                             const std::string& name = "altered") {
    const std::string to = path(name);
    fs::remove_all(to);
    fs::copy(path(from), to, fs::copy_options::recursive);
    const std::string changed = change(content(fs::path(to) / file));
    std::ofstream(fs::path(to) / file) << changed;
    return to;
  }

  static void expect_refused(const std::string& command, const std::string& recording,
                             const std::string& reason) {
    const std::string out = path("refused");
    fs::remove_all(out);
    const Outcome outcome = identify(command + " " + recording + " --out " + out);
    EXPECT_EQ(outcome.status, 2) << outcome.errors;
    EXPECT_EQ(outcome.lines(), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find(reason), std::string::npos)
        << outcome.errors << "expected to find: " << reason;
    EXPECT_FALSE(fs::exists(out)) << "something was written";
  }

  static fs::path root_;
};
fs::path IdentifyTool::root_;

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const auto at = text.find(what);
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

/// The first rows only.
std::string cut(const std::string& text, double share) {
  const auto end =
      text.find('\n', static_cast<std::size_t>(share * static_cast<double>(text.size())));
  return text.substr(0, end + 1);
}

/// The value of one cell; row 0 is the header.
std::string with_cell(const std::string& text, int row, int column, const std::string& value) {
  std::istringstream in(text);
  std::string out, line;
  for (int i = 0; std::getline(in, line); ++i) {
    if (i == row) {
      std::size_t begin = 0;
      for (int c = 0; c < column; ++c) begin = line.find(',', begin) + 1;
      line.replace(begin, std::min(line.find(',', begin), line.size()) - begin, value);
    }
    out += line + "\n";
  }
  return out;
}

/// All values of a column with the other sign.
std::string reversed(const std::string& text, const std::string& name) {
  std::istringstream in(text);
  std::string out, line;
  std::ptrdiff_t column = -1;
  while (std::getline(in, line)) {
    std::vector<std::string> cells(1);
    for (const char c : line) {
      if (c == ',') {
        cells.emplace_back();
      } else {
        cells.back() += c;
      }
    }
    if (column < 0) {
      column = std::find(cells.begin(), cells.end(), name) - cells.begin();
      EXPECT_LT(column, static_cast<std::ptrdiff_t>(cells.size())) << name;
    } else {
      std::string& cell = cells.at(static_cast<std::size_t>(column));
      cell = cell.rfind('-', 0) == 0 ? cell.substr(1) : "-" + cell;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) out += (i > 0 ? "," : "") + cells[i];
    out += "\n";
  }
  return out;
}

TEST_F(IdentifyTool, SpringsCanBePastedIntoAModel) {
  const Outcome outcome =
      identify("see " + path("ring_2") + " " + path("ring_1") + " --out " + path("see"));
  ASSERT_EQ(outcome.status, 0) << outcome.errors;
  for (const char* file : {"springs.yaml", "report.json", "stress_strain_10x5.svg",
                           "zener_10x5.svg", "wiechert_10x5.svg"}) {
    EXPECT_GT(fs::file_size(path("see") + "/" + file), 300u) << file;
  }
  for (const char* kind : {"ring_10x5", "ring_10x5_wiechert"}) {
    const std::string model = path("model.yaml");
    std::ofstream(model) << "extends: " << kConfig << "/rig_oring_stretcher/model_I.yaml\n"
                         << "muscles: {ring: {spring: {kind: " << kind << "}}}\n"
                         << content(path("see") + "/springs.yaml");
    const auto robot = load_robot_model(model, {0.002, {}});
    EXPECT_DOUBLE_EQ(robot->muscles[0].spring->rest_length(), 0.010) << kind;
  }
  const auto report = nlohmann::json::parse(content(path("see") + "/report.json"));
  const auto& wiechert = report["rings"][0]["models"][1];
  const double tau = wiechert["parameters"]["tau_2"]["value"];
  EXPECT_NEAR(tau, 2.9292, 0.3578);
  EXPECT_GT(wiechert["rmse"]["validation_N"], 0.0);
  EXPECT_EQ(content(path("see") + "/report.json").find("nan"), std::string::npos);
}

TEST_F(IdentifyTool, FrictionAndResistanceCanBePastedIntoModels) {
  std::string recordings;
  for (const char* name : {"eyelet_00", "eyelet_01", "eyelet_10", "eyelet_11"}) {
    recordings += " " + path(name);
  }
  ASSERT_EQ(identify("eyelet" + recordings + " --out " + path("eyelet")).status, 0);
  std::ofstream(path("model.yaml")) << "extends: " << kConfig << "/rig_eyelet_pull/model_I.yaml\n"
                                    << content(path("eyelet") + "/eyelet_friction.yaml");
  EXPECT_NO_THROW(load_robot_model(path("model.yaml")));
  EXPECT_TRUE(fs::exists(path("eyelet") + "/eyelet.svg"));

  ASSERT_EQ(identify("ecu " + path("ecu_1") + " " + path("ecu_2") + " --out " + path("ecu")).status,
            0);
  const ConfigNode stage = ConfigNode::load(path("ecu") + "/power_stage.yaml");
  EXPECT_NEAR(stage.at("power_stage").number("resistance", Bounds::positive(), "ohm"), 0.12, 0.01);
  EXPECT_TRUE(fs::exists(path("ecu") + "/ecu.svg"));
}

TEST_F(IdentifyTool, LeavesTheResultsOfAnotherCommand) {
  const fs::path out = path("shared");
  fs::create_directories(out);
  std::ofstream(out / "springs.yaml") << "springs: {}\n";
  ASSERT_EQ(
      identify("ecu " + path("ecu_1") + " " + path("ecu_2") + " --out " + out.string()).status, 0);
  EXPECT_EQ(content(out / "springs.yaml"), "springs: {}\n");
}

TEST_F(IdentifyTool, RefusesMisspeltKeysOfTheRig) {
  const auto with = [](const std::string& key, const std::string& other) {
    return [=](const std::string& text) { return replaced(text, key, other); };
  };
  expect_refused("see",
                 altered("ring_1", "meta.yaml",
                         with("effective_radius:", "scale_sgma: 0.1, effective_radius:")),
                 "rig.scale_sgma: unknown key");
  expect_refused("see", altered("ring_1", "meta.yaml", with("ring: ", "ring: a/")),
                 "specimen.ring: a/");
}

TEST_F(IdentifyTool, RefusesWhatIsNoRecording) {
  expect_refused("see", path("nowhere"), "nowhere");
  fs::create_directories(path("empty"));
  expect_refused("see", path("empty"), "meta.yaml is missing");
  expect_refused("see", altered("ring_1", "muscles.csv", [](auto) { return ""; }), "empty");
  expect_refused("see", altered("ring_1", "muscles.csv", [](auto text) { return cut(text, 0.0); }),
                 "0 rows");
}

TEST_F(IdentifyTool, RefusesTruncatedRecordings) {
  const auto half_row = [](std::string text) {
    return text.substr(0, text.find('\n', text.size() / 2) + 4);  // of its first cell, three signs
  };
  expect_refused("see", altered("ring_1", "muscles.csv", half_row), "muscles.csv:");
  expect_refused("see", altered("ring_1", "muscles.csv", [](auto text) { return cut(text, 0.56); }),
                 "cut off?");
  expect_refused("eyelet",
                 altered("eyelet_11", "rig.csv", [](auto text) { return cut(text, 0.3); }),
                 "cut off?");
  const auto mid_level = [](std::string text) { return cut(text, 0.95); };
  expect_refused("ecu", altered("ecu_1", "rig.csv", mid_level), "cut off?");
}

TEST_F(IdentifyTool, RefusesNumbersThatAreNone) {
  const auto bad = [](int column, const char* value) {
    return [=](const std::string& text) { return with_cell(text, 1000, column, value); };
  };
  expect_refused("see", altered("ring_1", "muscles.csv", bad(4, "nan")),
                 "muscles.csv:1001: ring/force: nan: expected a finite number");
  expect_refused("see", altered("ring_1", "muscles.csv", bad(2, "")), "ring/position: empty");
  expect_refused("eyelet", altered("eyelet_00", "rig.csv", bad(5, "inf")), "tendon/force: inf");
  expect_refused("eyelet", altered("eyelet_00", "rig.csv", bad(6, "99")), "weight/load: from");
  expect_refused("ecu", altered("ecu_1", "rig.csv", bad(3, "x")), "oscilloscope/voltage");
}

TEST_F(IdentifyTool, RefusesColumnsWithTheWrongSign) {
  const auto reverse = [](const char* column) {
    return [=](const std::string& text) { return reversed(text, column); };
  };
  const std::string hint = "reverse the sign of the column";
  expect_refused("see", altered("ring_1", "muscles.csv", reverse("ring/force")), "ring/force: -");
  expect_refused("see", altered("ring_1", "muscles.csv", reverse("ring/force")), hint);
  expect_refused("eyelet", altered("eyelet_00", "rig.csv", reverse("tendon/force")),
                 "tendon/force: mean of -");
  std::string turned;  // pulled where it is relaxed
  for (const char* name : {"eyelet_00", "eyelet_01", "eyelet_10", "eyelet_11"}) {
    turned +=
        " " + altered(name, "rig.csv", reverse("tendon/position"), std::string("turned_") + name);
  }
  expect_refused("eyelet", turned, "tendon/position: mu_k is -");
  expect_refused("eyelet", turned, hint);
  for (const char* column : {"oscilloscope/current", "oscilloscope/voltage"}) {
    expect_refused("ecu", altered("ecu_1", "rig.csv", reverse(column)),
                   std::string(column) + ": has the opposite sign of resistor/reference");
  }
}

TEST_F(IdentifyTool, RefusesWrongOrder) {
  const auto earlier = [](const std::string& text) { return with_cell(text, 1000, 0, "0.5"); };
  expect_refused("see", altered("ring_1", "muscles.csv", earlier), "expected time to grow");
  const auto twice = [](const std::string& text) { return with_cell(text, 3, 0, "0.002"); };
  expect_refused("see", altered("ring_1", "muscles.csv", twice), "at one time, 0.002 s");
  expect_refused("see", path("ring_1") + " " + path("ring_1"), "the same ring, specimen and run");
  expect_refused("eyelet", path("eyelet_00") + " " + path("eyelet_00"), "given twice");
  // The first release is missing.
  const auto without_start = [](const std::string& text) {
    const auto header = text.find('\n') + 1;
    return text.substr(0, header) + text.substr(text.find("\n7.000") + 1);
  };
  expect_refused("see", altered("ring_1", "muscles.csv", without_start), "starts stretched");
}

TEST_F(IdentifyTool, RefusesWrongNames) {
  expect_refused("see", path("eyelet_00"), "column 'ring/position' is missing");
  expect_refused("ecu", path("ring_1"), "its robot is 'rig_oring_stretcher'");
  const auto other_name = [](const std::string& text) {
    return replaced(text, "ring/force", "rong/force");
  };
  expect_refused("see", altered("ring_1", "muscles.csv", other_name), "'ring/force' is missing");
  const auto no_quantity = [](const std::string& text) {
    return replaced(text, "ring/force", "ring/tension");
  };
  expect_refused("see", altered("ring_1", "muscles.csv", no_quantity), "ring/tension");
  const auto no_specimen = [](const std::string& text) {
    return replaced(text, "specimen", "spec");
  };
  expect_refused("see", altered("ring_1", "meta.yaml", no_specimen), "specimen");
  const auto bad_radius = [](const std::string& text) {
    return replaced(text, "effective_radius: 0.0129", "effective_radius: -1");
  };
  expect_refused("see", altered("ring_1", "meta.yaml", bad_radius), "rig.effective_radius: -1");
}

TEST_F(IdentifyTool, SaysFirstThatItCannotWrite) {
  for (const std::string& out : {std::string("/proc/nowhere"), path("ring_1") + "/meta.yaml"}) {
    const Outcome outcome = identify("ecu " + path("ecu_1") + " --out " + out);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.lines(), 1) << outcome.errors;
    EXPECT_NE(outcome.errors.find("--out " + out), std::string::npos) << outcome.errors;
  }
}

TEST_F(IdentifyTool, RefusesWrongArguments) {
  for (const std::string& arguments : {std::string(""), std::string("see"), "see " + path("ring_1"),
                                       std::string("tea x --out y")}) {
    const Outcome outcome = identify(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_EQ(outcome.lines(), 1) << outcome.errors;
  }
}

}  // namespace
}  // namespace anthrob
