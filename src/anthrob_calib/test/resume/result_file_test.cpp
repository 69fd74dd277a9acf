#include "anthrob_calib/resume/result_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/errors.h"

namespace anthrob {
namespace resume {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kContext = 7;

using File = ResultFile<double>;

class ResultFileTest : public testing::Test {
 protected:
  void SetUp() override {
    File journal(file_, kContext);
    EXPECT_EQ(journal.inherited(), 0u);
    journal.append(1, first_);
    journal.append(2, {});  // no such robot
    journal.append(3, second_);
  }
  void TearDown() override { fs::remove(file_); }

  const std::string file_ =
      (fs::temp_directory_path() / ("anthrob_journal_" + std::to_string(getpid()))).string();
  const Eigen::VectorXd first_ = Eigen::VectorXd::LinSpaced(100, -1.0, 1.0);
  const Eigen::VectorXd second_ = Eigen::VectorXd::Constant(50, 1e-30);
};

TEST_F(ResultFileTest, KnowsWhatWasWrittenBitForBit) {
  const File journal(file_, kContext);
  EXPECT_EQ(journal.inherited(), 3u);
  EXPECT_EQ(journal.find(1).value(), first_);
  EXPECT_EQ(journal.find(2).value().size(), 0);
  EXPECT_EQ(journal.find(3).value(), second_);
  EXPECT_FALSE(journal.find(4).has_value());
}

TEST_F(ResultFileTest, AProgramIsAnotherOneWithAnotherLibrary) {
  const std::uint64_t program = program_fingerprint();
  EXPECT_EQ(program_fingerprint(program, {}), program);
  const std::uint64_t before = program_fingerprint(program, {file_});
  EXPECT_NE(before, program);
  EXPECT_EQ(program_fingerprint(program, {file_}), before);
  std::ofstream(file_, std::ios::app) << "rebuilt";
  EXPECT_NE(program_fingerprint(program, {file_}), before);
}

TEST_F(ResultFileTest, LosesOnlyTheRecordThatIsCutOff) {
  fs::resize_file(file_, fs::file_size(file_) - 3);
  {
    File journal(file_, kContext);
    EXPECT_EQ(journal.inherited(), 2u);
    EXPECT_FALSE(journal.find(3).has_value());
    journal.append(3, second_);
  }
  EXPECT_EQ(File(file_, kContext).find(3).value(), second_);
}

TEST_F(ResultFileTest, DoesNotBelieveABrokenRecord) {
  std::fstream stream(file_, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekp(120);
  stream.put('x');
  stream.close();
  const File journal(file_, kContext);
  EXPECT_FALSE(journal.find(1).has_value());
  EXPECT_EQ(journal.find(3).value(), second_);
}

TEST_F(ResultFileTest, OfAnotherContextIsBegunAnew) {
  EXPECT_FALSE(File(file_, kContext).begun_anew());
  {
    const File journal(file_, kContext + 1);
    EXPECT_EQ(journal.inherited(), 0u);
    EXPECT_TRUE(journal.begun_anew());
    EXPECT_FALSE(journal.find(1).has_value());
  }
  EXPECT_EQ(File(file_, kContext).inherited(), 3u);  // nothing was written instead
  {
    File journal(file_, kContext + 1);
    journal.append(1, second_);
  }
  EXPECT_EQ(File(file_, kContext + 1).find(1).value(), second_);
  EXPECT_EQ(File(file_, kContext).inherited(), 0u);
}

TEST_F(ResultFileTest, ServesOneRunAtATime) {
  const File journal(file_, kContext);
  EXPECT_THROW(File(file_, kContext), BadInput);
}

TEST_F(ResultFileTest, MakesItsFolderAndLeavesNothingIfThereIsNothingToLeave) {
  const std::string folder = file_ + "_folder";
  {
    const File journal(folder + "/journal.bin", kContext);
    EXPECT_TRUE(fs::exists(folder));
  }
  EXPECT_FALSE(fs::exists(folder));
  EXPECT_THROW(File(file_ + "/journal.bin", kContext), std::runtime_error);
}

TEST(Fingerprint, TellsApartWhatResultsDependOn) {
  EXPECT_NE(Fingerprint().add("ab").add("c").value(), Fingerprint().add("a").add("bc").value());
  EXPECT_NE(Fingerprint().add(0.0).value(), Fingerprint().add(-0.0).value());
  EXPECT_EQ(program_fingerprint(), program_fingerprint());
  EXPECT_NE(program_fingerprint(), Fingerprint().value());  // there are build ids
  const std::string config = ANTHROB_CONFIG_DIR;
  const auto of = [](const std::string& file) { return model_fingerprint(ConfigNode::load(file)); };
  EXPECT_EQ(of(config + "/anthrob/model_I.yaml"), of(config + "/anthrob/model_I.yaml"));
  EXPECT_NE(of(config + "/anthrob/model_I.yaml"), of(config + "/anthrob/model_II.yaml"));
}

TEST(Fingerprint, OfAModelKnowsTheFilesThatItNames) {
  const auto folder =
      fs::temp_directory_path() / ("anthrob_fingerprint_" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string model = (folder / "model.yaml").string();
  std::ofstream(model) << "robot: robot.urdf\n";
  std::ofstream(folder / "robot.urdf") << "one";
  const auto before = model_fingerprint(ConfigNode::load(model));
  std::ofstream(folder / "robot.urdf") << "two";
  EXPECT_NE(model_fingerprint(ConfigNode::load(model)), before);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace resume
}  // namespace anthrob
