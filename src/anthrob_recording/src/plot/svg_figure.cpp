#include "anthrob_recording/svg_figure.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/text.h"

namespace anthrob {

namespace {

constexpr double kWidth = 900, kPanelHeight = 260, kLeft = 70, kRight = 190, kTop = 36, kGap = 50;

const char* const kPalette[] = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e", "#9467bd", "#8c564b",
                                "#e377c2", "#17becf", "#bcbd22", "#000000", "#7f7f7f", "#aec7e8"};
constexpr int kColours = sizeof(kPalette) / sizeof(kPalette[0]);

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value + 0.0);  // no "-0"
  return text;
}

std::string coordinate(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.2f", value);
  return text;
}

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return "<text x=\"" + coordinate(x) + "\" y=\"" + coordinate(y) + "\" " + more + ">" +
         escaped(text) + "</text>\n";
}

struct Range {
  double lo = HUGE_VAL, hi = -HUGE_VAL;

  void include(double value) {
    if (!std::isfinite(value)) return;
    lo = std::min(lo, value), hi = std::max(hi, value);
  }
  void finish(double margin) {
    if (!(lo <= hi)) lo = 0.0, hi = 1.0;
    if (hi - lo < 1e-12 * std::max(1.0, std::abs(hi))) lo -= 0.5, hi += 0.5;
    const double room = margin * (hi - lo);
    lo -= room, hi += room;
  }
};

/// About five round steps: 1, 2 or 5 times a power of ten.
std::vector<double> ticks(const Range& range) {
  const double rough = (range.hi - range.lo) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  std::vector<double> list;
  for (double i = std::ceil(range.lo / step); i * step <= range.hi; ++i) list.push_back(i * step);
  return list;
}

/// A panel's mapping from data to page.
struct Frame {
  Range x, y;
  double top;

  double px(double value) const {
    return kLeft + (value - x.lo) / (x.hi - x.lo) * (kWidth - kLeft - kRight);
  }
  double py(double value) const { return top + (y.hi - value) / (y.hi - y.lo) * kPanelHeight; }
};

/// For ticks and label; names are longer.
double room_below(const SvgFigure::Panel& panel) {
  std::size_t longest = 0;
  for (const std::string& name : panel.names) longest = std::max(longest, name.size());
  return kGap + std::min(90.0, 3.2 * static_cast<double>(longest));
}

std::string axes(const Frame& frame, const SvgFigure::Panel& panel) {
  const double bottom = frame.top + kPanelHeight, right = kWidth - kRight;
  std::string out;
  const auto grid = [&](double t) {
    return "<path class=\"grid\" d=\"M" + coordinate(frame.px(t)) + " " + coordinate(frame.top) +
           "V" + coordinate(bottom) + "\"/>\n";
  };
  for (std::size_t i = 0; i < panel.names.size(); ++i) {
    const auto t = static_cast<double>(i);
    const std::string x = coordinate(frame.px(t)), y = coordinate(bottom + 14);
    out += grid(t) + text_at(frame.px(t), bottom + 14, panel.names[i],
                             "font-size=\"10\" text-anchor=\"end\" transform=\"rotate(-35 " + x +
                                 " " + y + ")\"");
  }
  for (const double t : panel.names.empty() ? ticks(frame.x) : std::vector<double>()) {
    out += grid(t) + text_at(frame.px(t), bottom + 16, number(t), "text-anchor=\"middle\"");
  }
  for (const double t : ticks(frame.y)) {
    const std::string y = coordinate(frame.py(t));
    out += "<path class=\"grid\" d=\"M" + coordinate(kLeft) + " " + y + "H" + coordinate(right) +
           "\"/>\n";
    out += text_at(kLeft - 6, frame.py(t) + 4, number(t), "text-anchor=\"end\"");
  }
  out += "<rect class=\"frame\" x=\"" + coordinate(kLeft) + "\" y=\"" + coordinate(frame.top) +
         "\" width=\"" + coordinate(right - kLeft) + "\" height=\"" + coordinate(kPanelHeight) +
         "\"/>\n";
  out += text_at(0.5 * (kLeft + right), bottom + room_below(panel) - 16, panel.x_label,
                 "text-anchor=\"middle\"");
  const double middle = frame.top + 0.5 * kPanelHeight;
  out += text_at(16, middle, panel.y_label,
                 "text-anchor=\"middle\" transform=\"rotate(-90 16 " + coordinate(middle) + ")\"");
  return out;
}

std::string polyline(const Frame& frame, const SvgFigure::Line& line, const std::string& colour) {
  std::string path;
  bool pen_down = false;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) {
      pen_down = false;
      continue;
    }
    path += (pen_down ? "L" : "M") + coordinate(frame.px(line.x[i])) + " " +
            coordinate(frame.py(line.y[i]));
    pen_down = true;
  }
  return "<path class=\"line\" stroke=\"" + colour + "\"" +
         (line.dashed ? " stroke-dasharray=\"5 3\"" : "") + " d=\"" + path + "\"/>\n";
}

bool has_stroke(const SvgFigure::Line& line, std::size_t i) {
  return i < line.low.size() && i < line.high.size() && std::isfinite(line.low[i]) &&
         std::isfinite(line.high[i]);
}

std::string mark(double x, double y, const SvgFigure::Line& line, const std::string& colour) {
  return "<circle cx=\"" + coordinate(x) + "\" cy=\"" + coordinate(y) + "\" r=\"" +
         (line.marks == SvgFigure::Line::kDots ? "1.5" : "3.5") + "\" stroke=\"" + colour +
         "\" fill=\"" + (line.marks == SvgFigure::Line::kOpen ? "white" : colour) + "\"/>\n";
}

std::string points(const Frame& frame, const SvgFigure::Line& line, const std::string& colour) {
  std::string out;
  for (std::size_t i = 0; i < line.x.size(); ++i) {
    if (!std::isfinite(line.x[i]) || !std::isfinite(line.y[i])) continue;
    const double x = frame.px(line.x[i]);
    if (has_stroke(line, i)) {
      out += "<path class=\"line\" stroke=\"" + colour + "\" d=\"M" + coordinate(x) + " " +
             coordinate(frame.py(line.low[i])) + "V" + coordinate(frame.py(line.high[i])) +
             "\"/>\n";
    }
    out += mark(x, frame.py(line.y[i]), line, colour);
  }
  return out;
}

/// A line's sign in the legend.
std::string sample(double x, double y, const SvgFigure::Line& line, const std::string& colour) {
  if (line.marks != SvgFigure::Line::kNone) return mark(x + 11, y, line, colour);
  return "<path class=\"line\" stroke=\"" + colour + "\"" +
         (line.dashed ? " stroke-dasharray=\"5 3\"" : "") + " d=\"M" + coordinate(x) + " " +
         coordinate(y) + "h22\"/>\n";
}

void include(const SvgFigure::Line& line, Frame& frame) {
  for (const double x : line.x) frame.x.include(x);
  for (std::size_t i = 0; i < line.y.size(); ++i) {
    frame.y.include(line.y[i]);
    if (has_stroke(line, i)) frame.y.include(line.low[i]), frame.y.include(line.high[i]);
  }
}

}  // namespace

SvgFigure::Panel& SvgFigure::add_panel(const std::string& x_label, const std::string& y_label) {
  panels_.push_back({x_label, y_label, {}, {}, false});
  return panels_.back();
}

std::string SvgFigure::render() const {
  double height = kTop;
  for (const Panel& panel : panels_) height += kPanelHeight + room_below(panel);
  std::string out = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    coordinate(kWidth) + " " + coordinate(height) + "\" width=\"" +
                    coordinate(kWidth) + "\" height=\"" + coordinate(height) +
                    "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<style>.grid{stroke:#ddd;fill:none}.frame{stroke:#333;fill:none}"
                    ".line{fill:none;stroke-width:1.5;stroke-linejoin:round}</style>\n"
                    "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  out += text_at(kLeft, 22, title_, "font-size=\"15\" font-weight=\"bold\"");
  double top = kTop;
  for (const Panel& panel : panels_) {
    Frame frame;
    frame.top = top;
    for (const Line& line : panel.lines) include(line, frame);
    if (panel.from_zero) frame.y.include(0.0);
    // Points on the frame would be half outside.
    const bool points_only = !panel.lines.empty() && panel.lines.front().marks != Line::kNone;
    frame.x.finish(!panel.names.empty() ? 0.08 : points_only ? 0.03 : 0.0);
    frame.y.finish(0.05);
    if (panel.from_zero && frame.y.lo < 0.0)
      frame.y.lo = std::min(0.0, frame.y.lo + 0.05 * (frame.y.hi - frame.y.lo) / 1.1);
    out += axes(frame, panel);
    double legend = top + 12;
    int next = 0;
    for (const Line& line : panel.lines) {
      const int index = line.colour >= 0 ? line.colour : next++;
      const std::string colour = kPalette[index % kColours];
      out +=
          line.marks == Line::kNone ? polyline(frame, line, colour) : points(frame, line, colour);
      if (line.label.empty()) continue;
      const double x = kWidth - kRight + 10;
      out += sample(x, legend - 4, line, colour) + text_at(x + 28, legend, line.label);
      legend += 17;
    }
    top += kPanelHeight + room_below(panel);
  }
  return out + "</svg>\n";
}

}  // namespace anthrob
