#include "panel/gains_panel.h"

#include <QEvent>
#include <QFileDialog>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>
#include <algorithm>
#include <utility>

#include "anthrob_ecu/gains.h"

namespace anthrob {
namespace {

constexpr double kGainsLimit = 10.0;  // [s] of wall time: a driver writes 20 ms for each gain
constexpr double kSaveLimit = 60.0;   // a program is started
constexpr double kGainsPeriod = 2.0;  // [s] others may change gains, too

}  // namespace

GainsPanel::GainsPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      state_(text_label("state")),
      muscle_(new QComboBox),
      undo_(new QPushButton("Undo")),
      grid_(new QGridLayout),
      answer_(text_label("answer")) {
  column()->addWidget(state_);
  muscle_->setObjectName("muscle");
  column()->addWidget(muscle_);
  column()->addLayout(grid_);
  add_buttons();
  column()->addWidget(answer_);
  column()->addStretch(1);
}

void GainsPanel::add_buttons() {
  auto* line = new QHBoxLayout;
  auto* save = new QPushButton("Save ...");
  undo_->setObjectName("undo");
  undo_->setToolTip("Takes back the last change that was made here");
  save->setObjectName("save");
  save->setToolTip("Saves what the robot holds, as a model file that extends the robot's own");
  line->addWidget(undo_);
  line->addWidget(save);
  column()->addLayout(line);
  connect(undo_, &QPushButton::clicked, this, [this] {
    if (table_.can_undo()) requests_.push_back({GainTable::Why::kUndo, table_.undo()});
  });
  connect(save, &QPushButton::clicked, this, [this] { choose_file(); });
}

void GainsPanel::begin() {
  table_.clear();
  requests_.clear();
  waiting_ = false;
  next_read_ = 0.0;
  answer_->clear();
  make_rows();
}

void GainsPanel::hear(const News& news, double) {
  for (const CallResult& answer : news.answers) {
    if (answer.service == "gains") take(answer);
    if (answer.service == "save_gains") note(answer);
  }
}

void GainsPanel::take(const CallResult& answer) {
  waiting_ = false;
  // A request that is refused before it reaches the robot has no gains with it.
  const auto names = table_.names(), muscles = table_.muscles();
  if (!answer.gains.empty()) table_.hear(answer.gains, asked_.why);
  if (names != table_.names() || muscles != table_.muscles()) make_rows();
  if (asked_.why != GainTable::Why::kRead || !answer.success) note(answer);
}

void GainsPanel::act(double now) {
  if (waiting_ || presence(now) == Presence::kAbsent) return;
  if (requests_.empty()) {
    if (!isVisible() || now < next_read_) return;
    next_read_ = now + kGainsPeriod;
    requests_.push_back({});
  }
  ServiceRequest request{"gains", kGainsLimit};
  request.gains = requests_.front().gains;
  if (!connection().call(request)) return;
  waiting_ = true;
  asked_ = requests_.front();
  requests_.pop_front();
}

void GainsPanel::make_rows() {
  for (const Row& row : std::exchange(rows_, {})) {
    delete row.number;
    delete row.remark;
  }
  while (QLayoutItem* item = grid_->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  const QString chosen = muscle_->currentText();
  muscle_->clear();
  if (table_.muscles().empty()) return;
  muscle_->addItem("all muscles");
  for (const std::string& name : table_.muscles()) muscle_->addItem(QString::fromStdString(name));
  muscle_->setCurrentIndex(std::max(0, muscle_->findText(chosen)));
  for (const std::string& name : table_.names()) add_row(name);
}

void GainsPanel::add_row(const std::string& name) {
  const ecu::ParameterInfo* info = ecu::find_gain(name);
  if (info == nullptr) return;  // of a robot that has other laws
  auto* label = new QLabel(QString::fromStdString(name).replace('_', ' '));
  auto* number = new QDoubleSpinBox;
  auto* remark = new QLabel;
  number->setObjectName(QString::fromStdString(name));
  remark->setObjectName(QString::fromStdString(name) + "_remark");
  number->setDecimals(5);
  number->setRange(static_cast<double>(info->lowest), static_cast<double>(info->highest));
  number->setSuffix(QString(" ") + info->unit);
  number->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  number->setKeyboardTracking(false);  // "12" is not 1 first
  number->setFocusPolicy(Qt::StrongFocus);
  number->installEventFilter(this);
  number->setToolTip(info->meaning);
  connect(number, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this, name](double value) {
            requests_.push_back({GainTable::Why::kChange, {{muscle(), name, value}}});
          });
  connect(number, &QDoubleSpinBox::editingFinished, this,
          [number] { number->findChild<QLineEdit*>()->setModified(false); });
  const int line = static_cast<int>(rows_.size());
  grid_->addWidget(label, line, 0);
  grid_->addWidget(number, line, 1);
  grid_->addWidget(remark, line, 2);
  rows_.push_back({name, number, remark});
}

/// The wheel changes nothing on its way.
bool GainsPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Wheel) return ConnectedPanel::eventFilter(watched, event);
  event->ignore();
  return true;
}

std::string GainsPanel::muscle() const {
  return muscle_->currentIndex() <= 0 ? "" : muscle_->currentText().toStdString();
}

void GainsPanel::choose_file() {
  const QString file =
      QFileDialog::getSaveFileName(this, "Save gains as a model", {}, "Models (*.yaml)");
  if (!file.isEmpty()) save_as(file.toStdString());
}

void GainsPanel::save_as(const std::string& file) {
  ServiceRequest request{"save_gains", kSaveLimit};
  request.name = file;
  if (connection().call(request)) show_text(answer_, "saving ...", colour_of(Level::kStale));
}

void GainsPanel::note(const CallResult& answer) {
  const std::string outcome = answer.success ? "done" : "failed";
  const std::string why = answer.message.empty() ? "" : ": " + answer.message;
  show_text(answer_, outcome + why, colour_of(answer.success ? Level::kOk : Level::kError));
}

void GainsPanel::refresh(double now) {
  const bool heard = presence(now) == Presence::kHeard;
  show_text(state_, state_text(now), colour_of(heard ? Level::kOk : Level::kWarning));
  undo_->setEnabled(table_.can_undo() && requests_.empty() && !waiting_);
  // What was just entered is not what is held yet.
  if (requests_.empty() && !(waiting_ && asked_.why != GainTable::Why::kRead)) {
    for (const Row& row : rows_) show_row(row);
  }
}

void GainsPanel::show_row(const Row& row) {
  const auto entry = table_.entry(muscle(), row.name);
  row.number->setEnabled(entry.has_value());
  if (!entry) return;
  row.remark->setText(entry->same ? "" : "differs");
  row.remark->setToolTip("Not the same for all muscles; a number that is entered here is");
  // A number that is being typed stays.
  if (row.number->findChild<QLineEdit*>()->isModified()) return;
  const QSignalBlocker quiet(row.number);
  row.number->setValue(entry->value);
}

}  // namespace anthrob
