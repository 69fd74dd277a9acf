#include "plot/plot_area.h"

#include <qcustomplot.h>

#include <QPrinter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <set>

#include "anthrob_core/text.h"
#include "anthrob_recording/svg_figure.h"
#include "scope/decimation.h"

namespace anthrob {
namespace {

// Those of our figures, so that a picture of either looks the same.
const char* const kColours[] = {"#1f77b4", "#d62728", "#2ca02c", "#ff7f0e", "#9467bd", "#8c564b",
                                "#e377c2", "#17becf", "#bcbd22", "#000000", "#7f7f7f", "#aec7e8"};
constexpr int kColourCount = 12;
constexpr Qt::PenStyle kStyles[] = {Qt::SolidLine, Qt::DashLine, Qt::DotLine, Qt::DashDotLine};

constexpr std::size_t kSmoothLines =
    20;                           // more are drawn without smooth edges, in a third of the time
constexpr int kEntryHeight = 17;  // [pixels] of a legend
constexpr double kGrabDistance = 8.0;  // [pixels] from a cursor
constexpr double kMargin = 0.06;       // above and below of what is fitted
constexpr double kPictureScale = 2.0;  // of a PNG, for documents
const char* const kNoName = "";

/// "muscle_states/force" of "/anthrob/muscle_states/force"
std::string without_robot(const std::string& group) {
  const std::size_t second = group.find('/', 1);
  return second == std::string::npos || group.find('/', second + 1) == std::string::npos
             ? group.substr(1)
             : group.substr(second + 1);
}

std::string title_of(const Quantity& quantity, Arrangement arrangement) {
  if (arrangement == Arrangement::kTogether) return "value";
  std::string title = without_robot(quantity.group);
  if (arrangement == Arrangement::kEach && title.substr(title.rfind('/') + 1) != quantity.label) {
    title += "/" + quantity.label;
  }
  return title + (quantity.unit ? " [" + *quantity.unit + "]" : kNoName);
}

std::string pane_key(const Quantity& quantity, Arrangement arrangement) {
  if (arrangement == Arrangement::kTogether) return kNoName;
  if (arrangement == Arrangement::kEach) return quantity.path;
  return quantity.group + " " + quantity.unit.value_or(kNoName);
}

Nanoseconds nanoseconds_in(double seconds_text) {
  return static_cast<Nanoseconds>(std::llround(std::clamp(1e9 * seconds_text, -9e18, 9e18)));
}

}  // namespace

PlotArea::PlotArea(QWidget* parent)
    : QWidget(parent), plot_(new QCustomPlot(this)), margins_(new QCPMarginGroup(plot_)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(plot_);
  plot_->setObjectName("plot");
  plot_->setAutoAddPlottableToLegend(false);
  plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
  plot_->setPlottingHint(QCP::phFastPolylines, true);
  plot_->plotLayout()->clear();
  connect(plot_, &QCustomPlot::mousePress, this, [this](QMouseEvent* event) { press(event); });
  connect(plot_, &QCustomPlot::mouseMove, this, [this](QMouseEvent* event) { move(event); });
  connect(plot_, &QCustomPlot::mouseRelease, this, [this](QMouseEvent*) { release(); });
}

void PlotArea::arrange(Arrangement arrangement) {
  arrangement_ = arrangement;
}

void PlotArea::set_range(const TimeRange& range) {
  if (!(range.end > range.begin)) return;
  range_ = range;
  setting_ = true;
  for (const Pane& pane : panes_)
    pane.rect->axis(QCPAxis::atBottom)->setRange(range.begin, range.end);
  setting_ = false;
}

void PlotArea::hear_range(double lower, double upper) {
  if (setting_) return;
  set_range({lower, upper});
  if (moved_) moved_();
}

void PlotArea::fit_values() {
  for (Pane& pane : panes_) pane.held = false;
}

/// Which plots there must be, without anything drawn yet.
std::vector<PlotArea::Pane> PlotArea::panes_for(const PlotContents& contents) const {
  std::set<std::size_t> sources;
  for (const Curve& curve : contents.curves) sources.insert(curve.source);
  std::vector<std::string> keys;
  std::vector<Pane> panes;
  std::map<std::pair<std::size_t, std::string>, int> colours;  // of a path in its plot
  const auto line_in = [&](const Curve& curve, const std::string& key, bool difference) {
    const auto found = std::find(keys.begin(), keys.end(), key);
    const auto index = static_cast<std::size_t>(found - keys.begin());
    if (found == keys.end()) {
      keys.push_back(key);
      panes.emplace_back();
      panes.back().title =
          (difference ? "difference, " : kNoName) + title_of(curve.quantity, arrangement_);
      panes.back().difference = difference;
    }
    Line line;
    line.path = curve.quantity.path, line.source = curve.source;
    line.colour =
        colours.emplace(std::make_pair(index, line.path), static_cast<int>(colours.size()))
            .first->second;
    const std::string name = arrangement_ == Arrangement::kTogether
                                 ? without_robot(curve.quantity.group) + "/" + curve.quantity.label
                                 : curve.quantity.label;
    line.label = QString::fromStdString(name);
    if (difference) return panes[index].lines.push_back(line);
    line.style = static_cast<int>(std::distance(sources.begin(), sources.find(curve.source)));
    if (sources.size() > 1)
      line.label += QString::fromStdString(" (" + contents.sources.at(curve.source) + ")");
    panes[index].lines.push_back(line);
  };
  for (const Curve& curve : contents.curves)
    line_in(curve, pane_key(curve.quantity, arrangement_), false);
  for (const CurvePair& pair : contents.pairs) {
    line_in(pair.first, "difference " + pane_key(pair.first.quantity, arrangement_), true);
  }
  // Colours begin anew in each plot, and a difference has that of its curves.
  for (Pane& pane : panes) {
    std::map<std::string, int> own;
    for (Line& line : pane.lines)
      line.colour = own.emplace(line.path, static_cast<int>(own.size())).first->second;
  }
  return panes;
}

void PlotArea::show_contents(const PlotContents& contents) {
  std::vector<Pane> panes = panes_for(contents);
  const auto same = [](const Pane& a, const Pane& b) {
    return a.title == b.title && a.difference == b.difference &&
           std::equal(a.lines.begin(), a.lines.end(), b.lines.begin(), b.lines.end(),
                      [](const Line& x, const Line& y) {
                        return x.path == y.path && x.source == y.source && x.style == y.style;
                      });
  };
  if (!std::equal(panes.begin(), panes.end(), panes_.begin(), panes_.end(), same))
    rebuild(std::move(panes));
  for (Pane& pane : panes_) fill(pane, contents);
  place_cursors();
  plot_->replot(QCustomPlot::rpQueuedRefresh);
}

void PlotArea::rebuild(std::vector<Pane> panes) {
  plot_->clearItems();
  plot_->clearGraphs();
  plot_->plotLayout()->clear();
  panes_ = std::move(panes);
  for (std::size_t i = 0; i < panes_.size(); ++i)
    build(panes_[i], static_cast<int>(i), i + 1 == panes_.size());
  plot_->plotLayout()->setColumnStretchFactor(0, 1.0);
  if (plot_->plotLayout()->columnCount() > 1) plot_->plotLayout()->setColumnStretchFactor(1, 0.001);
  set_range(range_);
}

void PlotArea::build(Pane& pane, int row, bool last) {
  pane.rect = new QCPAxisRect(plot_);
  plot_->plotLayout()->addElement(row, 0, pane.rect);
  pane.rect->setMarginGroup(QCP::msLeft | QCP::msRight, margins_);
  pane.rect->setMinimumMargins(QMargins(2, 4, 8, 2));
  // The wheel zooms time; over the numbers at the left, values.
  pane.rect->setRangeZoomAxes({pane.rect->axis(QCPAxis::atBottom)});
  pane.rect->setRangeDragAxes({pane.rect->axis(QCPAxis::atBottom)});
  QCPAxis* time = pane.rect->axis(QCPAxis::atBottom);
  QCPAxis* value = pane.rect->axis(QCPAxis::atLeft);
  value->setLabel(QString::fromStdString(pane.title));
  if (last) time->setLabel("time [s]");
  time->setTickLabels(last);
  connect(time, QOverload<const QCPRange&>::of(&QCPAxis::rangeChanged), this,
          [this](const QCPRange& range) { hear_range(range.lower, range.upper); });
  pane.legend = new QCPLegend;
  plot_->plotLayout()->addElement(row, 1, pane.legend);
  pane.legend->setLayer("legend");
  pane.legend->setBorderPen(Qt::NoPen);
  pane.legend->setFillOrder(QCPLayoutGrid::foRowsFirst);
  pane.legend->setMargins(QMargins(0, 4, 4, 0));
  pane.legend->setRowSpacing(0);
  add_graphs(pane, std::max(1, height() / (plots() * kEntryHeight) - 2));
  add_cursors(pane);
}

void PlotArea::add_graphs(Pane& pane, int most_entries) {
  const bool smooth = pane.lines.size() <= kSmoothLines;
  int entries = 0;
  for (Line& line : pane.lines) {
    line.graph =
        plot_->addGraph(pane.rect->axis(QCPAxis::atBottom), pane.rect->axis(QCPAxis::atLeft));
    line.graph->setPen(
        QPen(QColor(kColours[line.colour % kColourCount]), 1.0, kStyles[line.style % 4]));
    line.graph->setName(line.label);
    line.graph->setAntialiased(smooth);
    // What it gets is decimated already.
    line.graph->setAdaptiveSampling(false);
    if (++entries <= most_entries) line.graph->addToLegend(pane.legend);
  }
  const int left = entries - most_entries;
  if (left > 0) {
    auto* more = new QCPTextElement(plot_, QString("and %1 more").arg(left));
    more->setTextFlags(Qt::AlignLeft | Qt::AlignVCenter);
    pane.legend->addElement(more);
  }
  // The rest of the height stays empty.
  pane.legend->addElement(new QCPLayoutElement(plot_));
  pane.legend->setRowStretchFactor(pane.legend->rowCount() - 1, 1000.0);
}

void PlotArea::fill(Pane& pane, const PlotContents& contents) {
  std::size_t i = 0;
  if (pane.difference) {
    for (Line& line : pane.lines) {
      while (contents.pairs[i].first.quantity.path != line.path) ++i;
      const CurvePair& pair = contents.pairs[i];
      fill_line(line, SampleSpan(pair.comparison.difference), contents.origin, pair.first.zero);
    }
    label_differences(pane, contents);
  } else {
    for (Line& line : pane.lines) {
      const auto is_it = [&](const Curve& c) {
        return c.source == line.source && c.quantity.path == line.path;
      };
      const auto found = std::find_if(contents.curves.begin(), contents.curves.end(), is_it);
      fill_line(line, found->samples, contents.origin, found->zero);
    }
  }
  if (!pane.held) fit(pane);
}

void PlotArea::fill_line(Line& line, SampleSpan samples, double origin, Nanoseconds zero) {
  const Nanoseconds begin = zero + nanoseconds_in(range_.begin + origin),
                    end = zero + nanoseconds_in(range_.end + origin);
  const std::vector<Sample> drawn = decimated(samples, begin, end, columns(line));
  QVector<QCPGraphData> points;
  points.reserve(static_cast<int>(drawn.size()));
  for (const Sample& sample : drawn) {
    points.push_back(QCPGraphData(seconds(sample.t - zero) - origin, sample.value));
  }
  line.graph->data()->set(points, true);
}

/// The largest rms is what one looks for, so it stands in the legend.
void PlotArea::label_differences(Pane& pane, const PlotContents& contents) {
  for (Line& line : pane.lines) {
    for (const CurvePair& pair : contents.pairs) {
      if (pair.first.quantity.path != line.path) continue;
      const QString unit = QString::fromStdString(
          pair.first.quantity.unit ? " " + *pair.first.quantity.unit : kNoName);
      line.graph->setName(line.label + ": rms " +
                          QString::fromStdString(short_number(pair.comparison.rms)) + unit);
    }
  }
}

void PlotArea::fit(Pane& pane) const {
  double least = HUGE_VAL, greatest = -HUGE_VAL;
  for (const Line& line : pane.lines) {
    for (auto it = line.graph->data()->constBegin(); it != line.graph->data()->constEnd(); ++it) {
      if (!std::isfinite(it->value)) continue;
      least = std::min(least, it->value), greatest = std::max(greatest, it->value);
    }
  }
  if (!(least <= greatest)) return;
  double room = kMargin * (greatest - least);
  // A constant lies in the middle.
  if (room <= 1e-12 * std::max(std::abs(least), std::abs(greatest)))
    room = std::max(0.5, 0.05 * std::abs(least));
  pane.rect->axis(QCPAxis::atLeft)->setRange(least - room, greatest + room);
}

/// As many as the plot has pixels; half as many where so many lines lie upon each other that nobody
/// sees the difference.
int PlotArea::columns(const Line& line) const {
  const QCPAxisRect* rect = line.graph->keyAxis()->axisRect();
  const int width = rect->width() > 0 ? rect->width() : plot_->width();  // before it is laid out
  return std::clamp(line.graph->antialiased() ? width : width / 2, 200, 4000);
}

void PlotArea::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  // Legends have other lengths.
  panes_.clear();
  plot_->clearItems();
  plot_->clearGraphs();
  plot_->plotLayout()->clear();
  if (changed_) changed_();
}

// ---- cursors ------------------------------------------------------------------------------------

void PlotArea::set_cursors(bool shown) {
  if (shown && !with_cursors_) {
    const double width = range_.end - range_.begin;
    cursors_ = {range_.begin + width / 3.0, range_.begin + 2.0 * width / 3.0};
  }
  with_cursors_ = shown;
  place_cursors();
  plot_->replot(QCustomPlot::rpQueuedRefresh);
}

std::optional<TimeRange> PlotArea::cursors() const {
  if (!with_cursors_) return std::nullopt;
  return cursors_;
}

void PlotArea::add_cursors(Pane& pane) {
  for (int i = 0; i < 2; ++i) {
    auto* line = new QCPItemStraightLine(plot_);
    line->setClipAxisRect(pane.rect);
    for (QCPItemPosition* point : {line->point1, line->point2}) {
      point->setAxes(pane.rect->axis(QCPAxis::atBottom), pane.rect->axis(QCPAxis::atLeft));
      point->setAxisRect(pane.rect);
      point->setTypeX(QCPItemPosition::ptPlotCoords);
      point->setTypeY(QCPItemPosition::ptAxisRectRatio);
    }
    line->setPen(QPen(QColor(i == 0 ? "#d62728" : "#1f77b4"), 1.5, Qt::DashLine));
    pane.cursor[i] = line;
  }
}

void PlotArea::place_cursors() {
  for (Pane& pane : panes_) {
    for (int i = 0; i < 2; ++i) {
      const double at = i == 0 ? cursors_.begin : cursors_.end;
      pane.cursor[i]->point1->setCoords(at, 0.0);
      pane.cursor[i]->point2->setCoords(at, 1.0);
      pane.cursor[i]->setVisible(with_cursors_);
    }
  }
}

void PlotArea::press(QMouseEvent* event) {
  QCPAxisRect* rect = plot_->axisRectAt(event->localPos());
  if (rect == nullptr) return;
  for (Pane& pane : panes_) {
    QCPAxis* value = pane.rect->axis(QCPAxis::atLeft);
    const bool over_numbers = pane.rect == rect && event->pos().x() < rect->left();
    if (over_numbers && value != nullptr) pane.held = true;
  }
  if (!with_cursors_) return;
  const QCPAxis* time = rect->axis(QCPAxis::atBottom);
  const double first = std::abs(time->coordToPixel(cursors_.begin) - event->pos().x());
  const double second = std::abs(time->coordToPixel(cursors_.end) - event->pos().x());
  if (std::min(first, second) > kGrabDistance) return;
  dragged_ = first <= second ? 1 : 2;
  plot_->setInteraction(QCP::iRangeDrag, false);
}

void PlotArea::move(QMouseEvent* event) {
  if (dragged_ == 0 || panes_.empty()) return;
  const double at = panes_.front().rect->axis(QCPAxis::atBottom)->pixelToCoord(event->pos().x());
  (dragged_ == 1 ? cursors_.begin : cursors_.end) = at;
  place_cursors();
  plot_->replot(QCustomPlot::rpQueuedRefresh);
  if (changed_) changed_();
}

void PlotArea::release() {
  dragged_ = 0;
  plot_->setInteraction(QCP::iRangeDrag, true);
}

// ---- as a file ----------------------------------------------------------------------------------

std::string PlotArea::svg(const std::string& title) const {
  SvgFigure figure(title);
  for (const Pane& pane : panes_) {
    auto& panel = figure.add_panel("time [s]", pane.title);
    for (const Line& line : pane.lines) {
      SvgFigure::Line drawn;
      drawn.label = line.graph->name().toStdString();
      drawn.dashed = line.style % 4 != 0;
      drawn.colour = line.colour % kColourCount;
      for (auto it = line.graph->data()->constBegin(); it != line.graph->data()->constEnd(); ++it) {
        drawn.x.push_back(it->key), drawn.y.push_back(it->value);
      }
      panel.lines.push_back(std::move(drawn));
    }
  }
  return figure.render();
}

bool PlotArea::save_png(const std::string& file) const {
  return plot_->savePng(QString::fromStdString(file), plot_->width(), plot_->height(),
                        kPictureScale);
}

bool PlotArea::save_pdf(const std::string& file) const {
  return plot_->savePdf(QString::fromStdString(file), plot_->width(), plot_->height());
}

void PlotArea::print(QPrinter& printer) const {
  QCPPainter painter(&printer);
  const QRectF page = printer.pageRect(QPrinter::DevicePixel);
  const double scale = std::min(page.width() / plot_->width(), page.height() / plot_->height());
  painter.setMode(QCPPainter::pmVectorized);
  painter.setMode(QCPPainter::pmNoCaching);
  painter.scale(scale, scale);
  plot_->toPainter(&painter, plot_->width(), plot_->height());
}

}  // namespace anthrob
