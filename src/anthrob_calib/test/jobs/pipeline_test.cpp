// Stages of a calibration: which run comes next, from what it starts, and what is kept.
#include "jobs/pipeline.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace jobs {
namespace pipeline_test {

namespace fs = std::filesystem;

class PipelineTest : public testing::Test {
 protected:
  void SetUp() override {
    top_ = fs::temp_directory_path() / ("anthrob_pipeline_" + std::to_string(getpid()));
    fs::create_directories(top_);
  }
  void TearDown() override { fs::remove_all(top_); }

  std::string path(const std::string& name) const { return (top_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    fs::create_directories((top_ / name).parent_path());
    std::ofstream(path(name)) << text;
    return path(name);
  }
  /// What a run leaves.
  void leave(const std::string& run, double fitness) const {
    write("out/" + run + "/result.json",
          "{\"fitness\": {\"before\": 8.0, \"after\": " + std::to_string(fitness) + "}}");
  }
  std::string complaint(const std::string& text) const {
    try {
      load_stages(write("wrong.yaml", text));
    } catch (const BadInput& error) {
      return error.what();
    }
    return "accepted";
  }
  static std::string line(const Pipeline& pipeline) {
    return joined(pipeline.command().arguments, " ");
  }

  fs::path top_;
};

constexpr const char* kTwo = R"(stages:
  - {name: statics, config: s.yaml, data: runs/statics, validation: /held, options: [--generations, 8]}
  - {name: dynamics, config: ../d.yaml, data: runs/dynamics}
)";

TEST_F(PipelineTest, EachStageStartsFromTheBetterOfTwoRuns) {
  Pipeline pipeline(load_stages(write("robot/p.yaml", kTwo)), path("out"), 5, 2);
  EXPECT_EQ(pipeline.name(), "statics, seed 5");
  EXPECT_EQ(pipeline.share(0.5), 0.125);
  EXPECT_EQ(line(pipeline), "--config " + path("robot/s.yaml") + " --data " +
                                path("robot/runs/statics") + " --validation /held --out " +
                                path("out/statics/seed_5") + " --jobs 2 --seed 5 --generations 8");
  leave("statics/seed_5", 2.0);
  pipeline.finish("usable: fitness 8 -> 2");
  EXPECT_EQ(pipeline.summary(), "statics, seed 5: usable: fitness 8 -> 2\n");
  EXPECT_EQ(pipeline.name(), "statics, seed 6");
  leave("statics/seed_6", 1.0);
  pipeline.finish("look at these parameters: a");
  EXPECT_EQ(pipeline.summary(),
            "statics, seed 6: look at these parameters: a\nstatics: kept seed 6\n");
  for (const int seed : {5, 6}) {
    EXPECT_EQ(pipeline.name(), "dynamics, seed " + std::to_string(seed));
    EXPECT_NE(line(pipeline).find("--config " + path("d.yaml")), std::string::npos);
    EXPECT_NE(line(pipeline).find("--start " + path("out/statics/seed_6/result.json")),
              std::string::npos);
    leave("dynamics/seed_" + std::to_string(seed), 0.25);
    pipeline.finish("usable: fitness 8 -> 0.25");
  }
  EXPECT_FALSE(pipeline.name());
  EXPECT_EQ(pipeline.share(0.0), 1.0);
  EXPECT_EQ(pipeline.headline(), "usable: fitness 8 -> 0.25; look at the reports of statics");
  const OutputFiles files = pipeline.files();
  EXPECT_NE(files.at("model.yaml").find("\nextends: dynamics/seed_5/model.yaml\n"),
            std::string::npos);  // the first of equals
  EXPECT_NE(files.at("model.yaml").find("# statics, seed 6: fitness 8 -> 1"), std::string::npos);
  const auto json = nlohmann::json::parse(files.at("pipeline.json"));
  EXPECT_EQ(json["stages"][0]["kept"], 6);
  EXPECT_EQ(json["stages"][0]["runs"][1]["result"], "statics/seed_6/result.json");
  EXPECT_EQ(json["stages"][1]["runs"][0]["fitness"]["after"], 0.25);
}

TEST_F(PipelineTest, ARunWithoutAResultIsNotTakenForOne) {
  Pipeline pipeline(load_stages(write("p.yaml", kTwo)), path("out"), 1, 0);
  EXPECT_THROW(pipeline.finish("usable"), std::runtime_error);
  write("out/statics/seed_1/result.json", "{\"fitness\": {\"after\": null}}");
  EXPECT_THROW(pipeline.finish("usable"), std::runtime_error);
}

TEST_F(PipelineTest, RefusesWrongFilesByLineAndKey) {
  EXPECT_NE(complaint("stages: []\n").find("stages: "), std::string::npos);
  EXPECT_NE(complaint("stages:\n  - {name: a, config: a.yaml}\n").find("wrong.yaml:2: "),
            std::string::npos);
  EXPECT_NE(complaint("stages:\n  - {name: My stage, config: a, data: b}\n")
                .find("My stage: expected lower snake case"),
            std::string::npos);
  EXPECT_NE(complaint("stages:\n  - {name: a, config: a, data: b, seeds: 2}\n").find("seeds"),
            std::string::npos);
  EXPECT_NE(complaint("stages:\n  - {name: a, config: a, data: b}\n  - {name: a, config: a, data: "
                      "b}\n")
                .find("wrong.yaml:3: "),
            std::string::npos);
  EXPECT_NE(complaint("stages:\n  - {name: a, config: a, data: b, options: [--start, c]}\n")
                .find("--start: expected"),
            std::string::npos);
}

TEST_F(PipelineTest, NamesTheFilesThatItsRunsRead) {
  write("robot/model.yaml", "extends: base.yaml\n");
  write("robot/base.yaml", "gravity: 1\n");
  write("robot/s.yaml", "model: model.yaml\n");
  write("d.yaml", "generations: 3\n");
  const auto files = files_of(load_stages(write("robot/p.yaml", kTwo)));
  EXPECT_EQ(files.size(), 4u) << joined(files);
  for (const char* name : {"robot/model.yaml", "robot/base.yaml", "robot/s.yaml", "d.yaml"}) {
    EXPECT_EQ(std::count(files.begin(), files.end(), fs::canonical(top_ / name).string()), 1);
  }
}

}  // namespace pipeline_test
}  // namespace jobs
}  // namespace anthrob
