#include "panel/muscles_panel.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QScrollArea>
#include <QSignalBlocker>
#include <utility>

namespace anthrob {

MusclesPanel::MusclesPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      status_(text_label("status")),
      search_(new QLineEdit),
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
  auto* here = new QPushButton("Hold here");
  here->setObjectName("hold_here");
  here->setToolTip("All muscles: POSITION where they are, and hold");
  auto* relax = new QPushButton("Relax all");
  relax->setObjectName("relax_all");
  relax->setToolTip("All muscles: VOLTAGE 0 V, and hold; the arm sinks");
  hold_all_->setObjectName("hold_all");
  hold_all_->setToolTip("Repeats the commands of all muscles 20 times a second");
  line->addWidget(search_, 1);
  for (QWidget* widget : {static_cast<QWidget*>(here), static_cast<QWidget*>(relax),
                          static_cast<QWidget*>(hold_all_)}) {
    line->addWidget(widget);
  }
  column()->addLayout(line);
  connect(search_, &QLineEdit::textChanged, this, [this](const QString& text) { filter(text); });
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
  make_rows();
}

void MusclesPanel::hear(const News& news, double now) {
  for (const Diagnosis& diagnosis : news.diagnostics) diagnostics_.hear(diagnosis, now);
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
  filter(search_->text());
}

void MusclesPanel::filter(const QString& text) {
  for (MuscleRowWidget* row : rows_) {
    row->setVisible(row->name().contains(text.trimmed(), Qt::CaseInsensitive));
  }
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
