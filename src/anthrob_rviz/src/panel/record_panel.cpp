#include "panel/record_panel.h"

#include <sys/prctl.h>

#include <QDateTime>
#include <QDir>
#include <QFileInfo>
#include <QFormLayout>
#include <csignal>
#include <utility>

#include "anthrob_core/monotonic_clock.h"
#include "record_command.h"

namespace anthrob {
namespace {

constexpr int kClose_ms = 5000;  // for the last messages and the index of the bag

QString new_name() {
  return QDir::current().filePath(QDateTime::currentDateTime().toString("yyyy-MM-dd_hh-mm-ss") +
                                  ".bag");
}

std::string size_text(qint64 bytes) {
  return QString::number(1e-6 * static_cast<double>(bytes), 'f', 1).toStdString() + " MB";
}

}  // namespace

void RecordPanel::Recorder::setupChildProcess() {
  prctl(PR_SET_PDEATHSIG, SIGINT);
}

RecordPanel::RecordPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      state_(text_label("state")),
      file_(new QLineEdit(new_name())),
      what_(new QComboBox),
      duration_(new QSpinBox),
      button_(new QPushButton("Record")),
      answer_(text_label("answer")) {
  column()->addWidget(state_);
  add_fields();
  column()->addWidget(button_);
  column()->addWidget(answer_);
  column()->addStretch(1);
  button_->setObjectName("record");
  connect(button_, &QPushButton::clicked, this, [this] { toggle(); });
  connect(&recorder_, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), this,
          [this] { ended(); });
  connect(&recorder_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) tell("cannot start rosrun", Level::kError);
  });
}

RecordPanel::~RecordPanel() {
  finish();
}

void RecordPanel::add_fields() {
  auto* form = new QFormLayout;
  file_->setObjectName("file");
  what_->setObjectName("what");
  what_->addItem("commands and measurements");
  what_->addItem("everything");
  what_->setToolTip(
      "Replays, calibration and discovery need commands and measurements, from before "
      "anything moves the robot");
  duration_->setObjectName("duration");
  duration_->setRange(0, 24 * 3600);
  duration_->setSuffix(" s");
  duration_->setSpecialValueText("until stopped");
  form->addRow("Bag", file_);
  form->addRow("Topics", what_);
  form->addRow("Duration", duration_);
  column()->addLayout(form);
}

void RecordPanel::toggle() {
  records() ? interrupt() : start();
}

void RecordPanel::start() {
  bag_ = file_->text().trimmed().toStdString();
  const QFileInfo bag(QString::fromStdString(bag_));
  // The recorder would overwrite the one and wait for ever for the other.
  if (bag.exists()) return tell(bag_ + " is there already", Level::kError);
  if (!bag.dir().exists()) {
    return tell("there is no folder " + bag.dir().path().toStdString(), Level::kError);
  }
  if (bag.suffix() != "bag")
    return tell(bag_ + ": expected a name that ends in .bag", Level::kError);
  const auto what =
      what_->currentIndex() == 0 ? Recorded::kInputsAndMeasurements : Recorded::kEverything;
  const auto command = record_command(robot(), what, bag_, duration_->value());
  QStringList arguments;
  for (std::size_t i = 1; i < command.size(); ++i) arguments << QString::fromStdString(command[i]);
  began_ = monotonic_now();
  recorder_.setProcessChannelMode(QProcess::MergedChannels);
  recorder_.start(QString::fromStdString(command[0]), arguments);
}

void RecordPanel::interrupt() {
  ::kill(static_cast<pid_t>(recorder_.processId()), SIGINT);
}

void RecordPanel::finish() {
  if (!records()) return;
  interrupt();
  recorder_.waitForFinished(kClose_ms);
}

void RecordPanel::ended() {
  const QFileInfo bag(QString::fromStdString(bag_));
  const double time = monotonic_now() - began_;
  if (bag.exists()) {
    tell("wrote " + bag_ + ": " + std::to_string(static_cast<int>(time)) + " s, " +
             size_text(bag.size()),
         Level::kOk);
    file_->setText(new_name());
    return;
  }
  const QByteArray output = recorder_.readAll().trimmed();
  tell("no bag was written: " + output.mid(output.lastIndexOf('\n') + 1).toStdString(),
       Level::kError);
}

void RecordPanel::tell(const std::string& text, Level level) {
  show_text(answer_, text, colour_of(level));
}

void RecordPanel::end() {
  finish();
}

void RecordPanel::hear(const News&, double) {}

void RecordPanel::act(double) {}

void RecordPanel::refresh(double now) {
  const bool heard = presence(now) == Presence::kHeard;
  show_text(state_, state_text(now), colour_of(heard ? Level::kOk : Level::kWarning));
  button_->setText(records() ? "Stop recording" : "Record");
  for (QWidget* field : {static_cast<QWidget*>(file_), static_cast<QWidget*>(what_),
                         static_cast<QWidget*>(duration_)}) {
    field->setEnabled(!records());
  }
  if (!records()) return;
  const QFileInfo growing(QString::fromStdString(bag_ + ".active"));
  tell("recording " + bag_ + ": " + std::to_string(static_cast<int>(now - began_)) + " s, " +
           size_text(growing.size()),
       Level::kWarning);
}

}  // namespace anthrob
