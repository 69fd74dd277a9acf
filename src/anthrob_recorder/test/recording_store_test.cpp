#include "recording_store.h"

#include <gtest/gtest.h>

#include "support.h"

namespace anthrob {
namespace {

using testing_support::anthrob_folder;
using testing_support::content;
using testing_support::Folder;
using testing_support::tier1;

class RecordingStoreTest : public ::testing::Test {
 protected:
  RecordingStoreTest() {
    protocol = Protocol::load(anthrob_folder() + "record_tier1_trajectories.yaml", model);
    protocol.repeats = 2;
  }

  Sample sample(double angle) const {
    Sample s{1.0, std::vector<double>(8, 0.25), std::vector<double>(8, 3.0), {}};
    s.q = {std::cos(angle / 2), std::sin(angle / 2), 0.0, 0.0};
    return s;
  }

  void record(RecordingStore& store, const std::string& name, double angle) const {
    std::ofstream(store.partial_bag(name)) << "a bag";
    store.finish(name, {}, sample(angle));
  }

  std::shared_ptr<const RobotModel> model = tier1();
  Protocol protocol;
  Folder parent;
  std::string folder = parent.file("session");
};

TEST_F(RecordingStoreTest, ARecordingIsThereWhenItIsComplete) {
  RecordingStore store(folder, model, protocol, "true");
  const auto names = store.names(protocol.targets[2], 1);
  EXPECT_EQ(names, (std::vector<std::string>{"E0_to_E3_run1", "E3_to_E0_run1"}));
  EXPECT_FALSE(store.complete(names[0]));
  record(store, names[0], 0.1);
  EXPECT_TRUE(store.complete(names[0]));
  std::vector<std::string> remarks;
  const DatasetMeta meta = load_meta(folder + "/E0_to_E3_run1.yaml", &remarks);
  EXPECT_TRUE(remarks.empty());
  EXPECT_EQ(meta.robot, "anthrob");
  EXPECT_NE(meta.other.at("sample").find("lateral_deltoid: 0.25"), std::string::npos);
}

TEST_F(RecordingStoreTest, GoesOnWhereItWasInterrupted) {
  {
    RecordingStore store(folder, model, protocol, "true");
    EXPECT_EQ(store.baseline(), nullptr);
    store.set_baseline(sample(0.05));
    record(store, "E0_to_E3_run1", 0.1);
    std::ofstream(store.partial_bag("E3_to_E0_run1")) << "half a b";
    std::ofstream(folder + "/E0_to_E4_run1.yaml.part4711") << "half a d";
    std::ofstream(folder + "/E0_to_E4_run1.bag") << "killed before its description was written";
  }
  RecordingStore store(folder, model, protocol, "true");
  EXPECT_TRUE(store.complete("E0_to_E3_run1"));
  EXPECT_FALSE(store.complete("E3_to_E0_run1"));
  EXPECT_FALSE(store.complete("E0_to_E4_run1"));
  EXPECT_FALSE(std::filesystem::exists(store.partial_bag("E3_to_E0_run1")));
  EXPECT_FALSE(std::filesystem::exists(folder + "/E0_to_E4_run1.yaml.part4711"));
  ASSERT_NE(store.baseline(), nullptr);
  EXPECT_EQ(store.baseline()->q, sample(0.05).q);  // bit for bit
}

TEST_F(RecordingStoreTest, WhatIsNeverMeasuredOfALigamentIsLeftOut) {
  parent.write("ligament.yaml",
               "extends: " + anthrob_folder() +
                   "model_I_tier1.yaml\n"
                   "springs: {collagen: {type: spring_damper, rest_length: 0.02, stiffness: 1000, "
                   "damping: 5}}\nactuators: {ligament: {type: ligament}}\n"
                   "muscles:\n  capsule:\n    actuator: ligament\n    rest_tendon_length: 0.05\n"
                   "    spring: {kind: collagen, segment: 0}\n"
                   "    force_sensor_segment: 0\n    path:\n"
                   "      - {body: base, point: [-0.0402, -0.1710, 0.3485]}\n"
                   "      - {body: humerus, point: [-0.0091, 0.1702, -0.0147]}\n");
  model = load_robot_model(parent.file("ligament.yaml"));
  ASSERT_EQ(model->muscles.size(), 9u);
  Sample measured = sample(0.1);
  measured.position.push_back(std::nan(""));
  measured.force.push_back(std::nan(""));
  {
    RecordingStore store(folder, model, protocol, "true");
    store.set_baseline(measured);
    std::ofstream(store.partial_bag("E0_to_E3_run1")) << "a bag";
    store.finish("E0_to_E3_run1", {}, measured);
    store.summarise();
  }
  EXPECT_EQ(content(folder + "/samples.csv").find("nan"), std::string::npos);
  RecordingStore again(folder, model, protocol, "true");
  ASSERT_NE(again.baseline(), nullptr);
  EXPECT_TRUE(std::isnan(again.baseline()->force[8]));
  EXPECT_EQ(again.baseline()->force[7], 3.0);
  again.summarise();
}

TEST_F(RecordingStoreTest, AForceThatNoSensorMeasuresIsLeftOut) {
  Sample measured = sample(0.1);
  measured.force[2] = std::nan("");
  RecordingStore(folder, model, protocol, "true").set_baseline(measured);
  const RecordingStore again(folder, model, protocol, "true");
  ASSERT_NE(again.baseline(), nullptr);
  EXPECT_TRUE(std::isnan(again.baseline()->force[2]));
  EXPECT_EQ(again.baseline()->force[3], 3.0);
  EXPECT_EQ(again.baseline()->position[2], 0.25);
}

TEST_F(RecordingStoreTest, ASecondRecorderLeavesTheBagOfTheFirstOneAlone) {
  for (const bool begun : {false, true}) {
    const RecordingStore first(folder, model, protocol, "true");
    const std::string growing = first.partial_bag("E0_to_E3_run1");
    std::ofstream(growing) << "half a b";
    std::filesystem::create_directory_symlink(folder, parent.file("link"));
    for (const std::string& name : {folder, folder + "/.", parent.file("link")}) {
      try {
        RecordingStore(name, model, protocol, "true");
        ADD_FAILURE() << name << (begun ? ", continued" : ", new");
      } catch (const BadInput& error) {
        EXPECT_NE(std::string(error.what()).find("in use by another run"), std::string::npos)
            << error.what();
      }
    }
    std::filesystem::remove(parent.file("link"));
    EXPECT_EQ(content(growing), "half a b");
  }
  const RecordingStore next(folder, model, protocol, "true");
  EXPECT_FALSE(std::filesystem::exists(next.partial_bag("E0_to_E3_run1")));
}

TEST_F(RecordingStoreTest, GoesOnWhereItWasKilledAtItsVeryBeginning) {
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/session.yaml.part4711") << "# A sess";
  RecordingStore(folder, model, protocol, "true");
  EXPECT_FALSE(std::filesystem::exists(folder + "/session.yaml.part4711"));
  EXPECT_TRUE(std::filesystem::exists(folder + "/session.yaml"));
}

TEST_F(RecordingStoreTest, AFolderBelongsToOneSession) {
  RecordingStore(folder, model, protocol, "true");
  Protocol other = protocol;
  other.text += "hold: 1.0\n";
  EXPECT_THROW(RecordingStore(folder, model, other, "true"), BadInput);
  const auto model_II = load_robot_model(anthrob_folder() + "model_II_tier1.yaml");
  EXPECT_THROW(RecordingStore(folder, model_II, protocol, "true"), BadInput);
  EXPECT_THROW(RecordingStore(folder, model, protocol, "simulated"), BadInput);
  const std::string of_one = folder + "_simulated";
  const std::string robot = anthrob_folder() + "model_II_tier1.yaml";
  RecordingStore(of_one, model, protocol, "simulated", robot);
  RecordingStore(of_one, model, protocol, "simulated", robot);
  RecordingStore(of_one, model, protocol, "simulated");  // nobody says which
  EXPECT_THROW(
      RecordingStore(of_one, model, protocol, "simulated", anthrob_folder() + "model_I_tier1.yaml"),
      BadInput);
  std::filesystem::remove_all(of_one);
  EXPECT_NO_THROW(RecordingStore(folder, model, protocol, "true"));
}

TEST_F(RecordingStoreTest, SaysWhatIsWrongWithAFolder) {
  parent.write("file", "no folder");
  EXPECT_THROW(RecordingStore(parent.file("file/session"), model, protocol, "true"),
               std::runtime_error);
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/precious.txt") << "of somebody else";
  EXPECT_THROW(RecordingStore(folder, model, protocol, "true"), BadInput);
  std::filesystem::rename(folder + "/precious.txt", folder + "/precious.part");
  EXPECT_THROW(RecordingStore(folder, model, protocol, "true"), BadInput);
  EXPECT_TRUE(std::filesystem::exists(folder + "/precious.part"));
  std::filesystem::remove(folder + "/precious.part");
  std::ofstream(folder + "/session.yaml") << "protocol: [\n";
  EXPECT_THROW(RecordingStore(folder, model, protocol, "true"), BadInput);
  std::ofstream(folder + "/session.yaml") << "";
  EXPECT_THROW(RecordingStore(folder, model, protocol, "true"), BadInput);
}

TEST_F(RecordingStoreTest, ARecordingThatIsMadeAgainHasItsNewSample) {
  std::optional<RecordingStore> store;
  store.emplace(folder, model, protocol, "true");
  record(*store, "E0_to_E3_run1", 0.10);
  store->summarise();
  const std::string before = content(folder + "/samples.csv");
  record(*store, "E0_to_E3_run1", 0.20);
  store->summarise();
  EXPECT_NE(content(folder + "/samples.csv"), before);
  // As whoever reads it anew.
  const std::string after = content(folder + "/samples.csv");
  std::filesystem::remove(folder + "/samples.csv");
  store.reset();  // it holds the folder
  store.emplace(folder, model, protocol, "true");
  store->summarise();
  EXPECT_EQ(content(folder + "/samples.csv"), after);
}

TEST_F(RecordingStoreTest, TellsHowFarRepeatedRunsAreApart) {
  RecordingStore store(folder, model, protocol, "true");
  record(store, "E0_to_E3_run1", 0.10);
  record(store, "E0_to_E3_run2", 0.14);
  record(store, "E0_to_E4_run1", 0.30);
  store.summarise();
  std::istringstream rows(content(folder + "/repeatability.csv"));
  std::string header, row, more;
  std::getline(rows, header), std::getline(rows, row);
  EXPECT_EQ(row.substr(0, 16), "E3,shoulder,1,0.") << row;
  EXPECT_NEAR(std::stod(row.substr(14)), 0.04, 1e-9);
  EXPECT_FALSE(std::getline(rows, more));
  const std::string samples = content(folder + "/samples.csv");
  EXPECT_EQ(std::count(samples.begin(), samples.end(), '\n'), 4);
}

}  // namespace
}  // namespace anthrob
