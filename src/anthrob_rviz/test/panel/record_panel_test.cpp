#include "panel/record_panel.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

#include "panel/fake_robot.h"
#include "panel/gui.h"
#include "record_command.h"

namespace anthrob {
namespace {

using Words = std::vector<std::string>;

TEST(RecordCommand, NamesTopicsFromTheRoot) {
  const Words command = record_command("/lab/arm", Recorded::kInputsAndMeasurements, "a b.bag", 0);
  EXPECT_EQ(Words(command.begin(), command.begin() + 4),
            (Words{"rosrun", "rosbag", "record", "--output-name=a b.bag"}));
  EXPECT_EQ(command[4], "/lab/arm/muscle_command");
}

TEST(RecordCommand, OfEverythingEndsByItself) {
  const Words command = record_command("/arm", Recorded::kEverything, "a.bag", 30);
  EXPECT_EQ(command[4], "--duration=30");
  EXPECT_EQ(command[6], "(/arm/.*|/tf|/tf_static|/clock|/diagnostics)");
}

/// Without a ROS master nothing is recorded; what is wrong before that is told at once.
class RecordPanelTest : public testing::Test {
 protected:
  RecordPanelTest() {
    begin_application();
    panel_ = std::make_unique<RecordPanel>(
        std::make_unique<FakeConnection>(std::make_shared<FakeRobot>()), "anthrob");
    panel_->show();
    QTest::qWait(50);
  }
  std::string answer_to(const QString& file) {
    child<QLineEdit>(panel_.get(), "file")->setText(file);
    QTest::mouseClick(child<QPushButton>(panel_.get(), "record"), Qt::LeftButton);
    return child<QLabel>(panel_.get(), "answer")->text().toStdString();
  }

  QTemporaryDir folder_;
  std::unique_ptr<RecordPanel> panel_;
};

TEST_F(RecordPanelTest, OverwritesNothing) {
  const QString file = folder_.filePath("run.bag");
  QFile(file).open(QIODevice::WriteOnly);
  EXPECT_EQ(answer_to(file), file.toStdString() + " is there already");
}

TEST_F(RecordPanelTest, WantsAFolderAndANameOfABag) {
  EXPECT_EQ(answer_to(folder_.filePath("nowhere/run.bag")),
            "there is no folder " + folder_.filePath("nowhere").toStdString());
  EXPECT_EQ(answer_to(folder_.filePath("run")),
            folder_.filePath("run").toStdString() + ": expected a name that ends in .bag");
}

}  // namespace
}  // namespace anthrob
