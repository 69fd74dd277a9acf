#include "panel/scope_panel.h"

#include <gtest/gtest.h>

#include "panel/gui.h"
#include "scope/fake_sources.h"

namespace anthrob {
namespace {

std::unique_ptr<ScopeModel> fake_model() {
  return std::make_unique<ScopeModel>(std::make_unique<FakeLive>(std::make_shared<FakeTopics>()),
                                      open_fake);
}

TEST(ScopePanelTest, ItsLayoutIsKeptInTheConfiguration) {
  begin_application();
  const std::string layout =
      "{\"ticked\": [\"/robot/muscle_states/force/flexor\"], \"width_s\": 5}";
  rviz::Config written, read;
  written.mapSetValue("Layout", QString::fromStdString(layout));
  ScopePanel panel(fake_model());
  panel.load(written);
  panel.save(read);
  QString kept;
  ASSERT_TRUE(read.mapGetString("Layout", &kept));
  EXPECT_NE(kept.indexOf("\"ticked\":[\"/robot/muscle_states/force/flexor\"]"), -1)
      << kept.toStdString();
  EXPECT_NE(kept.indexOf("\"width_s\":5"), -1);
}

}  // namespace
}  // namespace anthrob
