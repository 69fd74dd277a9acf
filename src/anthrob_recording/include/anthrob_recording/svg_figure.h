#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// A line plot as SVG text: axes with round ticks, one or more panels below each other, a legend.
/// Enough for the figures of reports; opens in any browser and can stand inside an HTML page.
class SvgFigure {
 public:
  struct Line {
    std::string label;  ///< empty: not in the legend
    std::vector<double> x, y;
    bool dashed = false;
    int colour = -1;  ///< index into the palette; -1: the next one
    enum Marks { kNone, kFilled, kOpen, kDots } marks = kNone;  ///< points instead of a line
    std::vector<double> low = {}, high = {};  ///< ends of upright strokes at the points; or empty

    /// A point with an error bar. @param error half its length
    void add(double at, double value, double error) {
      x.push_back(at), y.push_back(value);
      low.push_back(value - error), high.push_back(value + error);
    }
  };

  struct Panel {
    std::string x_label, y_label;
    std::vector<Line> lines;
    std::vector<std::string> names = {};  ///< of x = 0, 1, 2 ... in place of numbers; or empty
    bool from_zero = false;               ///< the axis of y begins there
  };

  explicit SvgFigure(const std::string& title) : title_(title) {}

  Panel& add_panel(const std::string& x_label, const std::string& y_label);
  std::string render() const;

 private:
  std::string title_;
  std::vector<Panel> panels_;
};

}  // namespace anthrob
