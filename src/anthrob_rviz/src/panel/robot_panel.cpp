#include "panel/robot_panel.h"

#include <QGroupBox>
#include <QHBoxLayout>
#include <utility>

namespace anthrob {
namespace {

const char* const kStop = "disable";

// [s] of wall time. A stop answers at once or not at all; homing pulls one tendon after the other.
constexpr double kStopLimit = 1.0;
constexpr double kLimit = 5.0;
constexpr double kHomeLimit = 120.0;

const char* const kStopStyle =
    "QPushButton { background: #d32020; color: white; border: 2px solid #8e1010;"
    " border-radius: 6px; font-weight: bold; font-size: 22px; }"
    "QPushButton:pressed { background: #8e1010; }";

std::string shown_name(const std::string& service) {
  return service == kStop ? "STOP (disable)" : service;
}

}  // namespace

RobotPanel::RobotPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      state_(text_label("state")),
      answer_(text_label("answer")),
      simulator_(new QGroupBox("Simulator")),
      real_time_(new QLabel),
      steps_(new QSpinBox),
      rate_(new QDoubleSpinBox),
      snapshot_(new QLineEdit("here")),
      tree_(new DiagnosticsTree),
      key_([this] { stop(); }) {
  column()->addWidget(state_);
  add_stop();
  add_services();
  column()->addWidget(answer_);
  add_simulator();
  column()->addWidget(tree_, 1);
}

void RobotPanel::add_stop() {
  auto* button = new QPushButton("STOP  (space bar)");
  button->setObjectName("stop");
  button->setMinimumHeight(56);
  button->setStyleSheet(kStopStyle);
  button->setToolTip("Zero volts for all motors, by the service disable");
  // On pressing, not on releasing.
  connect(button, &QPushButton::pressed, this, [this] { stop(); });
  column()->addWidget(button);
}

void RobotPanel::add_services() {
  auto* line = new QHBoxLayout;
  add_button(line, "Enable", "enable", {"enable", kLimit})
      ->setToolTip("Motors follow references from the next command on");
  add_button(line, "Clear", "clear", {"clear_faults", kLimit})
      ->setToolTip("Clears faults and a latched stop; moves nothing");
  add_button(line, "Home", "home", {"home", kHomeLimit})
      ->setToolTip("Pulls all tendons to a common tension, and sets the zero there");
  add_button(line, "Zero gravity", "zero_gravity", {"controller/zero_gravity", kLimit})
      ->setToolTip("The computed-force controller, where one runs, lets the arm be moved by hand");
  column()->addLayout(line);
}

void RobotPanel::add_simulator() {
  auto* lines = new QVBoxLayout(simulator_);
  auto* first = new QHBoxLayout;
  ServiceRequest pause{"sim/pause", kLimit, true};
  ServiceRequest go_on{"sim/pause", kLimit, false};
  add_button(first, "Pause", "pause", pause);
  add_button(first, "Continue", "continue", go_on);
  add_button(first, "Reset", "reset", {"sim/reset", kLimit})->setToolTip("Back to rest");
  lines->addLayout(first);
  add_steps(lines);
  add_rate(lines);
  add_snapshots(lines);
  simulator_->setObjectName("simulator");
  simulator_->hide();
  column()->addWidget(simulator_);
}

void RobotPanel::add_steps(QVBoxLayout* lines) {
  auto* line = new QHBoxLayout;
  auto* step = new QPushButton("Step");
  step->setObjectName("step");
  step->setToolTip("Pauses, and takes so many steps of the simulation");
  connect(step, &QPushButton::clicked, this, [this] {
    call({"sim/step", kLimit, false, steps_->value()});
  });
  steps_->setObjectName("steps");
  steps_->setRange(1, 10000);
  line->addWidget(step);
  line->addWidget(steps_);
  line->addWidget(real_time_, 1);
  real_time_->setObjectName("real_time");
  real_time_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  lines->addLayout(line);
}

void RobotPanel::add_rate(QVBoxLayout* lines) {
  auto* line = new QHBoxLayout;
  auto* set = new QPushButton("Set rate");
  set->setObjectName("set_rate");
  set->setToolTip("How many times faster than real time; 0: as fast as possible");
  connect(set, &QPushButton::clicked, this, [this] {
    ServiceRequest request{"sim/set_rate", kLimit};
    request.factor = rate_->value();
    call(request);
  });
  rate_->setObjectName("rate");
  rate_->setRange(0.0, 100.0);
  rate_->setDecimals(3);
  rate_->setSingleStep(0.1);
  rate_->setValue(1.0);
  line->addWidget(set);
  line->addWidget(rate_, 1);
  lines->addLayout(line);
}

void RobotPanel::add_snapshots(QVBoxLayout* lines) {
  auto* line = new QHBoxLayout;
  snapshot_->setObjectName("snapshot");
  snapshot_->setToolTip("Name of a snapshot");
  line->addWidget(snapshot_, 1);
  for (const auto& [text, service] :
       {std::pair("Save", "sim/save"), std::pair("Restore", "sim/restore")}) {
    auto* button = new QPushButton(text);
    button->setObjectName(QString(text).toLower());
    connect(button, &QPushButton::clicked, this, [this, service = std::string(service)] {
      ServiceRequest request{service, kLimit};
      request.name = snapshot_->text().toStdString();
      call(request);
    });
    line->addWidget(button);
  }
  lines->addLayout(line);
}

QPushButton* RobotPanel::add_button(QLayout* line, const char* text, const char* name,
                                    const ServiceRequest& request) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  connect(button, &QPushButton::clicked, this, [this, request] { call(request); });
  line->addWidget(button);
  return button;
}

void RobotPanel::begin() {
  diagnostics_.clear();
  tree_->clear();
  answer_->clear();
}

void RobotPanel::stop() {
  call({kStop, kStopLimit});
}

void RobotPanel::call(const ServiceRequest& request) {
  if (!connection().call(request)) return;
  show_text(answer_, shown_name(request.service) + " ...", colour_of(Level::kStale));
}

void RobotPanel::note(const CallResult& answer) {
  if (answer.service == kStop && !answer.success) {
    // Whoever presses STOP means it: the topic needs no answer, and latches.
    connection().shout_stop();
    return show_text(answer_,
                     "STOP NOT CONFIRMED: " + answer.message + "; sent emergency_stop as well",
                     colour_of(Level::kError));
  }
  const std::string outcome = answer.success ? ": done" : ": failed";
  const std::string why = answer.message.empty() ? "" : ", " + answer.message;
  show_text(answer_, shown_name(answer.service) + outcome + why,
            colour_of(answer.success ? Level::kOk : Level::kError));
}

void RobotPanel::hear(const News& news, double now) {
  for (const Diagnosis& diagnosis : news.diagnostics) diagnostics_.hear(diagnosis, now);
  for (const CallResult& answer : news.answers) note(answer);
}

void RobotPanel::act(double) {}

void RobotPanel::refresh(double now) {
  show_state(now);
  show_simulator(now);
  tree_->show_all(diagnostics_.all(now));
}

void RobotPanel::show_state(double now) {
  const bool heard = presence(now) == Presence::kHeard;
  show_text(state_, state_text(now), colour_of(heard ? Level::kOk : Level::kWarning));
}

void RobotPanel::show_simulator(double now) {
  simulator_->setVisible(connection().simulated());
  const auto own = diagnostics_.of(robot(), "simulator", now);
  const std::string factor = own ? own->value("real_time_factor").value_or("?") : "?";
  const bool paused = own && own->message == "paused";
  real_time_->setText(QString::fromStdString(paused ? "paused" : "real time x " + factor));
}

}  // namespace anthrob
