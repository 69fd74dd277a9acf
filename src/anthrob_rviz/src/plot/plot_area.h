#pragma once

#include <QString>
#include <QWidget>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scope/scope_model.h"

class QCPAxisRect;
class QCPGraph;
class QCPItemStraightLine;
class QCPLegend;
class QCPMarginGroup;
class QCustomPlot;
class QMouseEvent;
class QPrinter;

namespace anthrob {

/// From left to right, in seconds of the time axis.
struct TimeRange {
  double begin = 0.0, end = 10.0;
};

/// What the plots show of curves.
struct PlotContents {
  std::vector<Curve> curves;
  std::vector<CurvePair> pairs;      ///< whose differences are plotted too
  std::vector<std::string> sources;  ///< their names; where there are several, curves bear them
  double origin = 0.0;               ///< [s] subtracted from all times
};

enum class Arrangement {
  kByGroup,   ///< one plot for each field of a topic
  kEach,      ///< one plot for each quantity
  kTogether,  ///< one plot
};

/// Plots below each other, with one time axis.
class PlotArea final : public QWidget {
 public:
  explicit PlotArea(QWidget* parent = nullptr);

  void arrange(Arrangement arrangement);
  Arrangement arrangement() const { return arrangement_; }
  void show_contents(const PlotContents& contents);

  TimeRange range() const { return range_; }
  void set_range(const TimeRange& range);
  /// Called when the user has moved or zoomed the time axis: to be shown again.
  void on_moved(std::function<void()> moved) { moved_ = std::move(moved); }
  /// The same of a cursor, or of the size.
  void on_changed(std::function<void()> changed) { changed_ = std::move(changed); }
  /// Values are fitted to what is visible until somebody zooms them, and again from here on.
  void fit_values();

  void set_cursors(bool shown);
  /// [s] of both cursors, if they are shown
  std::optional<TimeRange> cursors() const;

  // As it is on the screen.
  /// Text of an SVG file.
  std::string svg(const std::string& title) const;
  /// @return whether the file could be written
  bool save_png(const std::string& file) const;
  bool save_pdf(const std::string& file) const;
  void print(QPrinter& printer) const;
  int plots() const { return static_cast<int>(panes_.size()); }

 private:
  struct Line {
    std::string path;
    std::size_t source = 0;
    QString label;
    int colour = 0;
    int style = 0;  ///< of the source
    QCPGraph* graph = nullptr;
  };
  struct Pane {
    std::string title;
    bool difference = false;
    bool held = false;  ///< the user has zoomed its values
    std::vector<Line> lines;
    QCPAxisRect* rect = nullptr;
    QCPLegend* legend = nullptr;
    QCPItemStraightLine* cursor[2] = {nullptr, nullptr};
  };

  void resizeEvent(QResizeEvent* event) override;
  std::vector<Pane> panes_for(const PlotContents& contents) const;
  void rebuild(std::vector<Pane> panes);
  void build(Pane& pane, int row, bool last);
  void add_graphs(Pane& pane, int most_entries);
  void add_cursors(Pane& pane);
  void place_cursors();
  void fill(Pane& pane, const PlotContents& contents);
  void fill_line(Line& line, SampleSpan samples, double shift_seconds, Nanoseconds zero);
  void fit(Pane& pane) const;
  void label_differences(Pane& pane, const PlotContents& contents);
  void hear_range(double lower, double upper);
  void press(QMouseEvent* event);
  void move(QMouseEvent* event);
  void release();
  int columns(const Line& line) const;

  QCustomPlot* plot_;
  QCPMarginGroup* margins_;
  std::vector<Pane> panes_;
  Arrangement arrangement_ = Arrangement::kByGroup;
  TimeRange range_;
  bool setting_ = false;
  bool with_cursors_ = false;
  TimeRange cursors_;
  int dragged_ = 0;  ///< number of the cursor from 1; 0: none
  std::function<void()> moved_, changed_;
};

}  // namespace anthrob
