#include "panel/muscles_panel.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

namespace anthrob {
namespace {

const char* const kAllMuscles = "all muscles";

}  // namespace

MusclesPanel::MusclesPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      status_(text_label("status")),
      search_(new QLineEdit),
      group_(new QComboBox),
      hold_all_(new QCheckBox("hold all")),
      list_(new QVBoxLayout),
      commands_([this](const std::vector<Reference>& r) { this->connection().send(r); }) {
  column()->addWidget(status_);
  add_buttons();
  add_list();
}

void MusclesPanel::add_buttons() {
  auto* line = new QHBoxLayout;
  search_->setObjectName("search");
  search_->setPlaceholderText("Search");
  search_->setClearButtonEnabled(true);
  group_->setObjectName("group");
  group_->addItem(kAllMuscles);
  group_->setToolTip("Shows those that turn a joint one way, +, their antagonists, -, or those of "
                     "one motor unit");
  auto* chosen = new QHBoxLayout;
  chosen->addWidget(group_, 1);
  chosen->addWidget(search_, 1);
  column()->addLayout(chosen);
  auto* here = new QPushButton("Hold here");
  here->setObjectName("hold_here");
  here->setToolTip("All muscles: POSITION where they are, and hold");
  auto* relax = new QPushButton("Relax all");
  relax->setObjectName("relax_all");
  relax->setToolTip("All muscles: VOLTAGE 0 V, and hold; the arm sinks");
  auto* tighten = new QPushButton("Tighten all");
  tighten->setObjectName("tighten_all");
  tighten->setToolTip("All muscles: FORCE of at least 5 N, and hold");
  hold_all_->setObjectName("hold_all");
  hold_all_->setToolTip("Repeats the commands of all muscles 20 times a second");
  for (QWidget* widget : {static_cast<QWidget*>(here), static_cast<QWidget*>(relax),
                          static_cast<QWidget*>(tighten), static_cast<QWidget*>(hold_all_)}) {
    line->addWidget(widget);
  }
  column()->addLayout(line);
  connect(search_, &QLineEdit::textChanged, this, [this] { filter(); });
  connect(group_, &QComboBox::currentTextChanged, this, [this] { filter(); });
  connect(tighten, &QPushButton::clicked, this, [this] { board_.tighten_all(); });
  connect(here, &QPushButton::clicked, this, [this] { board_.hold_here(); });
  connect(relax, &QPushButton::clicked, this, [this] { board_.relax_all(); });
  connect(hold_all_, &QCheckBox::toggled, this, [this](bool held) { board_.hold_all(held); });
}

void MusclesPanel::add_list() {
  auto* area = new QScrollArea;
  auto* inside = new QWidget;
  auto* outer = new QVBoxLayout(inside);
  outer->setContentsMargins(0, 0, 0, 0);
  outer->addLayout(list_);
  outer->addStretch(1);
  list_->setSpacing(2);
  area->setWidget(inside);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column()->addWidget(area, 1);
}

void MusclesPanel::end() {
  commands_.set({}, 0.0);
}

void MusclesPanel::begin() {
  board_.clear();
  diagnostics_.clear();
  antagonists_.clear();
  make_rows();
}

void MusclesPanel::hear(const News& news, double now) {
  for (const Diagnosis& diagnosis : news.diagnostics) diagnostics_.hear(diagnosis, now);
  if (!news.antagonists.empty()) antagonists_ = news.antagonists;
  if (news.muscles && board_.hear(*news.muscles, now)) make_rows();
}

void MusclesPanel::make_rows() {
  for (MuscleRowWidget* row : std::exchange(rows_, {})) delete row;
  for (std::size_t i = 0; i < board_.rows().size(); ++i) {
    const std::string& name = board_.rows()[i].reading().name;
    rows_.push_back(
        new MuscleRowWidget(name, [this, i]() -> MuscleRow& { return board_.rows().at(i); }));
    list_->addWidget(rows_.back());
  }
  filter();
}

void MusclesPanel::filter() {
  const std::string chosen = group_->currentText().toStdString();
  const auto group = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const MuscleGroup& each) { return each.name == chosen; });
  for (MuscleRowWidget* row : rows_) {
    row->setVisible(row->name().contains(search_->text().trimmed(), Qt::CaseInsensitive) &&
                    (group == groups_.end() || group->has(row->name().toStdString())));
  }
}

/// The list changes seldom; what is chosen stays, if it is still there.
void MusclesPanel::show_groups(double now) {
  std::vector<std::string> muscles;
  for (const MuscleRow& row : board_.rows()) muscles.push_back(row.reading().name);
  groups_ = antagonists_;
  for (MuscleGroup& group : groups_by_unit(diagnostics_, robot(), muscles, now)) {
    groups_.push_back(std::move(group));
  }
  QStringList names{kAllMuscles}, shown;
  for (const MuscleGroup& group : groups_) names << QString::fromStdString(group.name);
  for (int i = 0; i < group_->count(); ++i) shown << group_->itemText(i);
  if (names == shown) return;
  const QString chosen = group_->currentText();
  const QSignalBlocker quiet(group_);
  group_->clear();
  group_->addItems(names);
  group_->setCurrentIndex(std::max(0, group_->findText(chosen)));
  filter();
}

void MusclesPanel::act(double now) {
  commands_.set(board_.take(now), board_.deadline(now));
}

void MusclesPanel::refresh(double now) {
  board_.set_limits(connection().limits());
  const double force_limit = connection().limits().of(ControlMode::kForce).high;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    // Of a hundred muscles ten are in sight.
    if (rows_[i]->visibleRegion().isEmpty()) continue;
    rows_[i]->show_row(board_.fresh(now), remark_of(board_.rows()[i], now), force_limit);
  }
  show_groups(now);
  const QSignalBlocker quiet(hold_all_);
  hold_all_->setChecked(board_.all_held());
  show_status(now);
}

void MusclesPanel::show_status(double now) {
  const auto& stopped = board_.stopped();
  if (stopped && presence(now) == Presence::kHeard) {
    return show_text(status_, "Commands ended: " + *stopped, colour_of(Level::kError));
  }
  const std::string ended = stopped ? ". Commands ended: " + *stopped : "";
  const Level level = presence(now) == Presence::kHeard ? Level::kOk : Level::kWarning;
  show_text(status_, state_text(now) + ended, colour_of(level));
}

std::string MusclesPanel::remark_of(const MuscleRow& row, double now) const {
  const MuscleReading& reading = row.reading();
  if (reading.state == EcuState::kFault) {
    const auto unit = diagnostics_.unit_of_muscle(robot(), reading.name, now);
    return unit ? unit->message : "fault: see the diagnostics";
  }
  const auto remark = row.remark(now);
  if (!remark) return {};
  const std::string rejection = row.active() ? last_rejection(now) : "";
  return rejection.empty() ? *remark : *remark + " (" + rejection + ")";
}

/// Why the robot refused a command, in its own words.
std::string MusclesPanel::last_rejection(double now) const {
  for (const char* part : {"simulator", "driver"}) {
    const auto own = diagnostics_.of(robot(), part, now);
    if (own) return own->value("last_rejection").value_or("");
  }
  return {};
}

void MusclesPanel::showEvent(QShowEvent* event) {
  rviz::Panel::showEvent(event);
  board_.show(true);
}

void MusclesPanel::hideEvent(QHideEvent* event) {
  rviz::Panel::hideEvent(event);
  board_.show(false);
  commands_.set({}, 0.0);
  for (MuscleRowWidget* row : rows_) row->let_go();
}

}  // namespace anthrob
