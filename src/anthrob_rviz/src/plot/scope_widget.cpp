#include "plot/scope_widget.h"

#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QMenu>
#include <QMimeData>
#include <QSplitter>
#include <QUrl>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace {

constexpr int kRefresh_ms = 33;
constexpr double kFirstWidth = 10.0;  // [s] of what is live
constexpr int kMostValues = 200;      // rows of the cursors' table

const char* const kNoteStyle = "color: #606060";
const char* const kErrorStyle = "color: #c62020";

/// "4.25", or nothing where the curve has no value.
QString number_text(const std::optional<double>& value) {
  return value ? QString::number(*value, 'g', 6) : QString("-");
}

}  // namespace

ScopeWidget::ScopeWidget(std::unique_ptr<ScopeModel> model, QWidget* parent)
    : QWidget(parent),
      model_(std::move(model)),
      sources_(new SourceList),
      filter_(new QLineEdit),
      tree_(new QuantityTree),
      plots_(new PlotArea),
      trigger_(new TriggerBar),
      stack_(new QStackedWidget),
      empty_(new QLabel),
      note_(new QLabel),
      values_(new QTableWidget(0, 4)),
      mode_(new QComboBox),
      arrangement_(new QComboBox) {
  setAcceptDrops(true);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  build_toolbar(column);
  auto* halves = new QSplitter(Qt::Horizontal);
  halves->addWidget(build_left());
  halves->addWidget(build_right());
  halves->setStretchFactor(1, 1);
  halves->setSizes({280, 720});
  column->addWidget(halves, 1);
  note_->setObjectName("note");
  note_->setWordWrap(true);
  note_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  note_->hide();
  column->addWidget(note_);
  connect_parts();
  timer_.start(kRefresh_ms);
}

// ---- its parts ----------------------------------------------------------------------------------

QPushButton* ScopeWidget::add_switch(QHBoxLayout* line, const char* text, const char* name,
                                     const char* tip) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  button->setCheckable(true);
  button->setToolTip(tip);
  line->addWidget(button);
  return button;
}

void ScopeWidget::add_menu(QHBoxLayout* line) {
  auto* open = new QPushButton("Open ...");
  open->setToolTip("Opens bags or data set folders; they can be dropped into the window, too");
  connect(open, &QPushButton::clicked, this, [this] { ask_to_open(); });
  line->addWidget(open);
  auto* file = new QPushButton("File");
  auto* menu = new QMenu(file);
  const auto add = [&](const char* text, void (ScopeWidget::*act)()) {
    connect(menu->addAction(text), &QAction::triggered, this, [this, act] { (this->*act)(); });
  };
  add("Export ... (CSV, SVG, PDF, PNG)", &ScopeWidget::ask_to_export);
  add("Print ...", &ScopeWidget::print);
  add("Save layout ...", &ScopeWidget::ask_to_save_layout);
  add("Load layout ...", &ScopeWidget::ask_to_load_layout);
  file->setMenu(menu);
  line->addWidget(file);
}

void ScopeWidget::build_toolbar(QVBoxLayout* column) {
  auto* line = new QHBoxLayout;
  add_menu(line);
  auto* fit_all = new QPushButton("Fit");
  fit_all->setObjectName("fit");
  fit_all->setToolTip(
      "All that there is. Wheel: zooms time; wheel over the numbers at the left: zooms values; "
      "drag: moves");
  connect(fit_all, &QPushButton::clicked, this, [this] { fit(); });
  line->addWidget(fit_all);
  follow_ = add_switch(line, "Follow", "follow", "Keeps the newest live sample in sight");
  follow_->setChecked(true);
  freeze_ = add_switch(line, "Freeze", "freeze",
                       "Stops the picture; what comes meanwhile is shown later");
  cursors_ = add_switch(line, "Cursors", "cursors", "Two lines to drag, and the values there");
  differences_ =
      add_switch(line, "Difference", "differences", "Second source minus first one, and its rms");
  arrangement_->setObjectName("arrangement");
  arrangement_->addItems({"a plot per field", "a plot per quantity", "one plot"});
  line->addWidget(arrangement_);
  mode_->setObjectName("mode");
  mode_->addItems({"normal", "oscilloscope"});
  line->addWidget(mode_);
  line->addStretch(1);
  column->addLayout(line);
  trigger_->hide();
  column->addWidget(trigger_);
}

QWidget* ScopeWidget::build_left() {
  auto* left = new QWidget;
  auto* column = new QVBoxLayout(left);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(sources_);
  filter_->setObjectName("filter");
  filter_->setPlaceholderText("search: force, biceps, ...");
  filter_->setClearButtonEnabled(true);
  column->addWidget(filter_);
  column->addWidget(tree_, 1);
  return left;
}

QWidget* ScopeWidget::build_right() {
  empty_->setObjectName("empty");
  empty_->setAlignment(Qt::AlignCenter);
  empty_->setWordWrap(true);
  empty_->setStyleSheet("background: white; color: #606060; font-size: 15px; padding: 30px");
  stack_->addWidget(empty_);
  auto* page = new QSplitter(Qt::Vertical);
  page->addWidget(plots_);
  values_->setObjectName("values");
  values_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  values_->verticalHeader()->hide();
  values_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  values_->hide();
  page->addWidget(values_);
  page->setChildrenCollapsible(false);
  plots_->setMinimumHeight(120);
  page->setStretchFactor(0, 4);
  page->setStretchFactor(1, 1);
  stack_->addWidget(page);
  return stack_;
}

void ScopeWidget::connect_parts() {
  const auto changed = [this] { dirty_ = true; };
  connect(filter_, &QLineEdit::textChanged, this,
          [this](const QString& text) { tree_->filter(text); });
  tree_->on_tick([this](const std::set<std::string>& paths, bool ticked) {
    try {
      model_->tick(paths, ticked);
    } catch (const std::runtime_error& error) {
      note(error.what(), true);
    }
    if (ticked && model_->ticked().size() == paths.size()) fit();
    dirty_ = true;
  });
  tree_->on_open([this] { model_->look_into(tree_->open_topics()); });
  sources_->on_show([this](std::size_t i, bool shown) { model_->show(i, shown), dirty_ = true; });
  sources_->on_shift(
      [this](std::size_t i, double later) { model_->shift(i, later), dirty_ = true; });
  sources_->on_close([this](std::size_t i) { model_->close(i), dirty_ = true; });
  trigger_->on_change(changed);
  plots_->on_moved([this] {
    follow_->setChecked(false);
    dirty_ = true;
  });
  plots_->on_changed(changed);
  connect(follow_, &QPushButton::toggled, this, changed);
  connect(freeze_, &QPushButton::toggled, this, [this](bool on) { set_frozen(on); });
  connect(cursors_, &QPushButton::toggled, this, [this](bool on) {
    plots_->set_cursors(on);
    values_->setVisible(on);
    dirty_ = true;
  });
  connect(differences_, &QPushButton::toggled, this, changed);
  connect(arrangement_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this](int index) {
            plots_->arrange(static_cast<Arrangement>(index));
            dirty_ = true;
          });
  connect(mode_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          [this](int index) { set_mode(static_cast<Mode>(index)); });
  connect(&timer_, &QTimer::timeout, this, [this] { refresh(); });
}

// ---- what it does -------------------------------------------------------------------------------

std::optional<std::string> ScopeWidget::open(const std::string& path) {
  try {
    model_->open(path);
  } catch (const std::runtime_error& error) {
    note(error.what(), true);
    return error.what();
  }
  note_->hide();
  fit();
  refresh_tree();
  return std::nullopt;
}

void ScopeWidget::tick(const std::set<std::string>& paths) {
  model_->tick(paths, true);
  tree_->show_ticks(model_->ticked());
  fit();
}

void ScopeWidget::set_mode(Mode mode) {
  mode_->setCurrentIndex(static_cast<int>(mode));
  trigger_->setVisible(mode == Mode::kOscilloscope);
  origin_ = 0.0;
  if (mode == Mode::kNormal) fit();
  dirty_ = true;
}

void ScopeWidget::set_frozen(bool frozen) {
  model_->freeze(frozen);
  freeze_->setChecked(frozen);
  dirty_ = true;
}

void ScopeWidget::set_differences(bool shown) {
  differences_->setChecked(shown);
}

void ScopeWidget::fit() {
  plots_->fit_values();
  double begin = HUGE_VAL, end = -HUGE_VAL;
  for (const Curve& curve : model_->curves()) {
    if (curve.source == 0) continue;
    begin = std::min(begin, curve.seconds_of(curve.samples.front().t));
    end = std::max(end, curve.seconds_of(curve.samples.back().t));
  }
  follow_->setChecked(true);
  dirty_ = true;
  if (begin < end) return plots_->set_range({begin, end});
  plots_->set_range({0.0, kFirstWidth});
}

void ScopeWidget::refresh() {
  const bool came = model_->poll();
  for (const std::string& remark : model_->take_remarks()) note(remark, false);
  refresh_tree();
  if (!isVisible()) return;
  if (!dirty_ && (!came || model_->frozen())) return;
  dirty_ = false;
  redraw();
}

void ScopeWidget::refresh_tree() {
  const MasterView master = model_->master();
  sources_->show_sources(model_->sources(), live_text(master));
  if (model_->version() == tree_version_ && master.topics == tree_topics_) {
    if (stack_->currentIndex() == 0) show_empty_state();
    return;
  }
  tree_version_ = model_->version();
  tree_topics_ = master.topics;
  tree_->show_quantities(model_->quantities(), master.topics, model_->ticked());
  dirty_ = true;
}

void ScopeWidget::redraw() {
  std::vector<Curve> curves = model_->curves();
  trigger_->offer(curves);
  stack_->setCurrentIndex(curves.empty() ? 0 : 1);
  if (curves.empty()) return show_empty_state();
  if (mode_->currentIndex() == static_cast<int>(Mode::kOscilloscope)) {
    const auto origin = trigger_origin(curves);
    if (origin) origin_ = *origin;
    const TriggerChoice choice = trigger_->choice();
    const double width = seconds(choice.trigger.width);
    plots_->set_range({-choice.trigger.pre * width, (1.0 - choice.trigger.pre) * width});
  } else {
    follow(curves);
  }
  show_cursor_values(curves);
  plots_->show_contents(contents_of(std::move(curves)));
}

PlotContents ScopeWidget::contents_of(std::vector<Curve> curves) const {
  PlotContents contents;
  if (differences_->isChecked()) contents.pairs = pairs_of(curves);
  contents.curves = std::move(curves);
  for (const SourceView& source : model_->sources()) contents.sources.push_back(source.name);
  contents.origin = origin_;
  return contents;
}

/// Moves the time axis so that the newest live sample is at its right end.
void ScopeWidget::follow(const std::vector<Curve>& curves) {
  if (!follow_->isChecked() || model_->frozen()) return;
  std::optional<double> newest;
  for (const Curve& curve : curves) {
    if (curve.source == 0)
      newest = std::max(newest.value_or(-HUGE_VAL), curve.seconds_of(curve.samples.back().t));
  }
  const TimeRange range = plots_->range();
  const double width = range.end - range.begin;
  if (newest && *newest > width)
    plots_->set_range({*newest - width, *newest});
  else if (newest && range.begin != 0.0)
    plots_->set_range({0.0, width});
}

/// The instant of the crossing on the time axis.
std::optional<double> ScopeWidget::trigger_origin(const std::vector<Curve>& curves) {
  const TriggerChoice choice = trigger_->choice();
  for (const Curve& curve : curves) {
    if (curve.quantity.path != choice.path) continue;
    const auto sweep = last_sweep(curve.samples, choice.trigger);
    if (!sweep) return std::nullopt;
    if (choice.single && !model_->frozen()) set_frozen(true);
    return curve.seconds_of(sweep->crossing);
  }
  return std::nullopt;
}

void ScopeWidget::show_cursor_values(const std::vector<Curve>& curves) {
  const auto cursors = plots_->cursors();
  if (!cursors) return;
  const auto time_text_of = [](const char* name, double t) {
    return QString("%1: %2 s").arg(name).arg(t, 0, 'f', 4);
  };
  values_->setHorizontalHeaderLabels({"", time_text_of("red", cursors->begin),
                                      time_text_of("blue", cursors->end),
                                      time_text_of("blue - red", cursors->end - cursors->begin)});
  const int rows = std::min(static_cast<int>(curves.size()), kMostValues);
  values_->setRowCount(rows);
  const auto instant = [&](const Curve& curve, double t) {
    return curve.zero + static_cast<Nanoseconds>(std::llround(1e9 * (t + origin_)));
  };
  for (int row = 0; row < rows; ++row) {
    const Curve& curve = curves[static_cast<std::size_t>(row)];
    const auto first = value_at(curve.samples, instant(curve, cursors->begin));
    const auto second = value_at(curve.samples, instant(curve, cursors->end));
    std::optional<double> difference;
    if (first && second) difference = *second - *first;
    const std::string unit =
        curve.quantity.unit ? " [" + *curve.quantity.unit + "]" : std::string();
    const std::string source =
        model_->sources().size() > 1 ? model_->sources()[curve.source].name + ": " : std::string();
    const QString texts[] = {QString::fromStdString(source + curve.quantity.path + unit),
                             number_text(first), number_text(second), number_text(difference)};
    for (int i = 0; i < 4; ++i) values_->setItem(row, i, new QTableWidgetItem(texts[i]));
  }
}

// ---- what it says -------------------------------------------------------------------------------

std::string ScopeWidget::live_text(const MasterView& master) const {
  return master.answers ? "live: " + master.uri : "live: no ROS master at " + master.uri;
}

std::string ScopeWidget::empty_text() const {
  if (!model_->ticked().empty() && !model_->quantities().empty()) {
    return "Nothing of what is ticked has come yet.";
  }
  if (!model_->quantities().empty() || !model_->master().topics.empty()) {
    return "Tick a quantity on the left. Topics of a running robot tell what they have once you "
           "open them.";
  }
  return "There is no ROS master at " + model_->master().uri +
         ". Drop a bag or a data set folder here, or start a robot: roslaunch anthrob_bringup "
         "sim.launch";
}

void ScopeWidget::show_empty_state() {
  const QString text = QString::fromStdString(empty_text());
  if (empty_->text() != text) empty_->setText(text);
}

void ScopeWidget::note(const std::string& text, bool error) {
  note_->setStyleSheet(error ? kErrorStyle : kNoteStyle);
  note_->setText(QString::fromStdString(text));
  note_->show();
}

// ---- files --------------------------------------------------------------------------------------

void ScopeWidget::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void ScopeWidget::dropEvent(QDropEvent* event) {
  for (const QUrl& url : event->mimeData()->urls()) {
    if (url.isLocalFile())
      open(url.toLocalFile().toStdString());
    else
      note("'" + url.toString().toStdString() + "' is no file of this computer", true);
  }
  event->acceptProposedAction();
}

void ScopeWidget::ask_to_open() {
  const QStringList files = QFileDialog::getOpenFileNames(
      this, "Open recordings", QString(), "Bags, data sets (*.bag meta.yaml);;All files (*)");
  for (const QString& file : files) {
    const bool dataset = QFileInfo(file).fileName() == "meta.yaml";
    open((dataset ? QFileInfo(file).path() : file).toStdString());
  }
}

}  // namespace anthrob
