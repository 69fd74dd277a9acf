#include "anthrob_recording/svg_figure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

namespace anthrob {
namespace {

std::size_t count_of(const std::string& pattern, const std::string& text) {
  const std::regex regex(pattern);
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), regex), {}));
}

TEST(SvgFigure, NamesStandInPlaceOfNumbers) {
  SvgFigure figure("errors");
  auto& panel = figure.add_panel("", "error [deg]");
  panel.names = {"E0_E1", "E1_E0 <back>"};
  SvgFigure::Line line{"after", {0.0, 1.0}, {3.0, 4.0}};
  line.marks = SvgFigure::Line::kFilled;
  panel.lines = {line};
  const std::string svg = figure.render();
  EXPECT_EQ(count_of(">E0_E1</text>", svg), 1u);
  EXPECT_EQ(count_of(">E1_E0 &lt;back&gt;</text>", svg), 1u);
  EXPECT_EQ(count_of(">0.5</text>", svg), 0u);  // a tick of x
  EXPECT_EQ(count_of("<circle", svg), 3u);      // two points and the legend
}

TEST(SvgFigure, AnAxisFromZeroBeginsThere) {
  for (const bool from_zero : {false, true}) {
    SvgFigure figure("errors");
    auto& panel = figure.add_panel("", "");
    panel.from_zero = from_zero;
    panel.lines = {{"", {0.0, 1.0}, {30.0, 40.0}}};
    const std::string svg = figure.render();
    EXPECT_EQ(count_of("text-anchor=\"end\">0</text>", svg), from_zero ? 1u : 0u);
    EXPECT_EQ(count_of("text-anchor=\"end\">-", svg), 0u);
  }
}

TEST(SvgFigure, StrokesAreDrawnWhereBothEndsAreKnown) {
  SvgFigure figure("bars");
  auto& panel = figure.add_panel("", "");
  SvgFigure::Line line;
  line.marks = SvgFigure::Line::kFilled;
  line.add(0.0, 1.0, 0.5);
  line.add(1.0, 2.0, NAN);
  panel.lines = {line};
  EXPECT_EQ(count_of("class=\"line\"", figure.render()), 1u);
}

}  // namespace
}  // namespace anthrob
