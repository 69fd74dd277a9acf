#include "plot/scope_widget.h"

#include <gtest/gtest.h>

#include <QCheckBox>
#include <QMimeData>
#include <QTreeWidgetItemIterator>
#include <filesystem>

#include "anthrob_core/testing/content.h"
#include "panel/gui.h"
#include "scope/fake_sources.h"

namespace anthrob {
namespace {

class ScopeWidgetTest : public testing::Test {
 protected:
  ScopeWidgetTest() {
    begin_application();
    scope_ = std::make_unique<ScopeWidget>(
        std::make_unique<ScopeModel>(std::make_unique<FakeLive>(topics_), open_fake));
    scope_->resize(1000, 600);
    scope_->show();
    static_cast<void>(QTest::qWaitForWindowExposed(scope_.get()));
    settle();
  }

  /// What the timers would do, without waiting for them.
  void settle() {
    for (int i = 0; i < 2; ++i) QApplication::processEvents(), scope_->refresh();
    QApplication::processEvents();
  }
  std::string text(const char* label) {
    return child<QLabel>(scope_.get(), label)->text().toStdString();
  }
  QTreeWidgetItem* item(const QString& name) {
    const auto* tree = child<QTreeWidget>(scope_.get(), "quantities");
    const auto found = tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive);
    return found.isEmpty() ? nullptr : found.first();
  }
  void drop(const QString& file) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(file)});
    QDragEnterEvent enter(QPoint(500, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(scope_.get(), &enter);
    QDropEvent event(QPointF(500, 300), Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(scope_.get(), &event);
    settle();
  }
  void click(const char* button) { child<QPushButton>(scope_.get(), button)->click(), settle(); }

  std::shared_ptr<FakeTopics> topics_ = std::make_shared<FakeTopics>();
  std::unique_ptr<ScopeWidget> scope_;
};

TEST_F(ScopeWidgetTest, AnEmptyWindowSaysWhatToDo) {
  EXPECT_EQ(text("empty").rfind("Tick a quantity on the left.", 0), 0U);
  topics_->master.answers = false, topics_->master.topics.clear();
  settle();
  EXPECT_EQ(text("empty").rfind("There is no ROS master at http://localhost:11311. Drop a bag", 0),
            0U);
  EXPECT_EQ(child<QCheckBox>(scope_.get(), "source_0")->text(),
            "live: no ROS master at http://localhost:11311");
}

TEST_F(ScopeWidgetTest, ATopicThatIsOpenedShowsWhatItHasAndATickPlotsIt) {
  ASSERT_NE(item("/robot/muscle_states"), nullptr);
  item("/robot/muscle_states")->setExpanded(true);
  EXPECT_EQ(topics_->heard.size(), 1U);
  topics_->send(1000000000, {"flexor", "extensor"}, {1.0, 2.0});
  settle();
  ASSERT_NE(item("force"), nullptr);
  EXPECT_EQ(item("flexor")->text(1), "N");
  // The branch ticks both.
  item("force")->setCheckState(0, Qt::Checked);
  settle();
  EXPECT_EQ(scope_->model().ticked().size(), 2U);
  topics_->send(2000000000, {"flexor", "extensor"}, {1.0, 2.0});
  settle();
  EXPECT_EQ(scope_->plots().plots(), 1);
  EXPECT_NE(scope_->plots().svg("Scope").find("extensor"), std::string::npos);
}

TEST_F(ScopeWidgetTest, DroppedRecordingsLieUponEachOtherWithTheirRms) {
  drop("/data/a.bag"), drop("/data/b.bag");
  ASSERT_NE(item("flexor"), nullptr);
  item("flexor")->setCheckState(0, Qt::Checked);
  settle();
  click("differences");
  EXPECT_EQ(scope_->plots().plots(), 2);
  const std::string svg = scope_->plots().svg("Scope");
  EXPECT_NE(svg.find("flexor (a.bag)"), std::string::npos);
  EXPECT_NE(svg.find("flexor (b.bag)"), std::string::npos);
  EXPECT_NE(svg.find("flexor: rms 2 N"), std::string::npos) << svg.substr(svg.find("rms"), 40);
}

TEST_F(ScopeWidgetTest, ABadRecordingIsOneLineInTheWindow) {
  drop("/data/none.bag");
  EXPECT_EQ(text("note"), "/data/none.bag: no bag; expected a recording");
  EXPECT_TRUE(child<QLabel>(scope_.get(), "note")->isVisible());
}

TEST_F(ScopeWidgetTest, TheTimeAxisIsFittedFollowedAndFrozen) {
  drop("/data/a.bag");
  scope_->tick({force_of("flexor").path});
  EXPECT_NEAR(scope_->plots().range().end, 10.0, 1e-9);
  scope_->model().show(1, false);
  for (int i = 0; i <= 30; ++i) topics_->send(i * Nanoseconds{1000000000}, {"flexor"}, {1.0});
  scope_->fit();
  settle();
  EXPECT_NEAR(scope_->plots().range().end, 30.0, 1e-9);
  click("freeze");
  topics_->send(40000000000, {"flexor"}, {1.0});
  settle();
  EXPECT_NEAR(scope_->plots().range().end, 30.0, 1e-9);
  click("freeze");
  EXPECT_NEAR(scope_->plots().range().end, 40.0, 1e-9);
}

TEST_F(ScopeWidgetTest, TheOscilloscopeStandsAtItsTrigger) {
  drop("/data/a.bag");
  scope_->tick({force_of("flexor").path});
  child<QComboBox>(scope_.get(), "mode")->setCurrentIndex(1);
  child<QDoubleSpinBox>(scope_.get(), "trigger_level")->setValue(4.005);
  settle();
  EXPECT_NEAR(scope_->plots().range().begin, -0.2, 1e-9);
  EXPECT_NEAR(scope_->plots().range().end, 0.8, 1e-9);
  // The force rises above 4.005 N at 3.005 s: there is 0.
  const std::string file =
      std::filesystem::temp_directory_path() /
      ("anthrob_scope_" + std::to_string(QApplication::applicationPid()) + ".svg");
  EXPECT_FALSE(scope_->export_to(file));
  EXPECT_NE(content(file).find("<svg"), std::string::npos);
  std::filesystem::remove(file);
  click("cursors");
  auto* values = child<QTableWidget>(scope_.get(), "values");
  ASSERT_EQ(values->rowCount(), 1);
  const double first = values->item(0, 1)->text().toDouble(),
               second = values->item(0, 2)->text().toDouble();
  EXPECT_NEAR(first, 4.005 - 0.2 + 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(second - first, 1.0 / 3.0, 1e-3);
}

TEST_F(ScopeWidgetTest, EveryKindOfFileIsWritten) {
  EXPECT_TRUE(scope_->export_to("/nowhere/x.csv"));
  drop("/data/a.bag");
  scope_->tick({force_of("flexor").path});
  settle();
  const std::string stem = std::filesystem::temp_directory_path() /
                           ("anthrob_scope_" + std::to_string(QApplication::applicationPid()));
  const std::pair<const char*, const char*> beginnings[] = {
      {".csv", "stamp,/robot/muscle_states/force/flexor\n100.000,1\n"},
      {".svg", "<svg"},
      {".pdf", "%PDF"},
      {".png", "\x89PNG"}};
  for (const auto& [ending, beginning] : beginnings) {
    EXPECT_EQ(scope_->export_to(stem + ending), std::nullopt);
    EXPECT_EQ(content(stem + ending).rfind(beginning, 0), 0U)
        << ending << content(stem + ending).substr(0, 80);
    std::filesystem::remove(stem + ending);
  }
  EXPECT_NE(scope_->export_to(stem + ".xyz").value_or("").find("expected a name that ends in"),
            std::string::npos);
  EXPECT_TRUE(scope_->export_to("/nowhere/x.png"));
}

TEST_F(ScopeWidgetTest, ALayoutIsRestored) {
  drop("/data/a.bag"), drop("/data/b.bag");
  scope_->model().shift(2, 0.5);
  scope_->tick({force_of("extensor").path});
  scope_->set_differences(true);
  child<QComboBox>(scope_.get(), "arrangement")->setCurrentIndex(1);
  const QString layout = scope_->layout_text();
  ScopeWidget other(std::make_unique<ScopeModel>(std::make_unique<FakeLive>(topics_), open_fake));
  EXPECT_EQ(other.restore_layout(layout), std::nullopt);
  EXPECT_EQ(other.layout_text(), layout);
  EXPECT_EQ(other.model().sources().at(2).later, 0.5);
  EXPECT_NE(other.restore_layout("{"), std::nullopt);
  EXPECT_NE(other.restore_layout("{\"recordings\": [{\"path\": \"/data/none.bag\"}]}"),
            std::nullopt);
}

}  // namespace
}  // namespace anthrob
