#include "panel/connected_panel.h"

#include <QHBoxLayout>
#include <utility>

#include "anthrob_core/monotonic_clock.h"
#include "dead_man.h"

namespace anthrob {
namespace {

constexpr int kTick_ms = 20;            // less than anybody feels between mouse and motor
constexpr double kRefreshPeriod = 0.1;  // [s] faster cannot be read

const char* const kRobotKey = "Robot";  // in the .rviz file

}  // namespace

ConnectedPanel::ConnectedPanel(std::unique_ptr<RobotConnection> connection,
                               const std::string& robot)
    : connection_(std::move(connection)),
      robot_(robot_namespace(robot).value_or("/anthrob")),
      column_(new QVBoxLayout(this)),
      edit_(new QLineEdit(QString::fromStdString(robot_.substr(1)))) {
  column_->setContentsMargins(6, 6, 6, 6);
  column_->setSpacing(6);
  auto* line = new QHBoxLayout;
  line->addWidget(new QLabel("Robot"));
  line->addWidget(edit_);
  column_->addLayout(line);
  edit_->setObjectName("robot");
  edit_->setToolTip("Namespace of the robot's topics and services");
  connect(edit_, &QLineEdit::editingFinished, this, [this] { choose(edit_->text()); });
  connect(&timer_, &QTimer::timeout, this, [this] { tick(); });
  timer_.setTimerType(Qt::PreciseTimer);
  timer_.start(kTick_ms);
}

void ConnectedPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString text;
  if (config.mapGetString(kRobotKey, &text)) choose(text);
}

void ConnectedPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue(kRobotKey, QString::fromStdString(robot_.substr(1)));
}

void ConnectedPanel::choose(const QString& text) {
  const auto chosen = robot_namespace(text.toStdString());
  const bool another = chosen && *chosen != robot_;
  if (another) {
    robot_ = *chosen;
    connected_ = false;
    Q_EMIT configChanged();
  }
  // What cannot be a namespace is taken back.
  edit_->setText(QString::fromStdString(robot_.substr(1)));
}

void ConnectedPanel::connect_robot() {
  end();
  heard_.reset();
  summary_ = {};
  connection_->connect(robot_);
  connected_ = true;
  begin();
}

/// The first one connects: only then is the panel whole, and its configuration loaded.
void ConnectedPanel::tick() {
  if (!connected_) connect_robot();
  const News news = connection_->look();
  const double now = monotonic_now();
  if (news.muscles) {
    heard_ = now;
    summary_ = summary_of(*news.muscles);
  }
  hear(news, now);
  act(now);
  if (now < next_refresh_) return;
  next_refresh_ = now + kRefreshPeriod;
  if (isVisible()) refresh(now);
}

Presence ConnectedPanel::presence(double now) const {
  if (!heard_) return Presence::kAbsent;
  return now - *heard_ > DeadMan::kStale ? Presence::kSilent : Presence::kHeard;
}

std::string ConnectedPanel::state_text(double now) const {
  return state_line(robot_, presence(now), summary_);
}

QString colour_of(Level level) {
  switch (level) {
    case Level::kOk:
      return "#2e8b3d";
    case Level::kWarning:
      return "#c77700";
    case Level::kError:
      return "#c62020";
    case Level::kStale:
      return "#808080";
  }
  return "#808080";
}

QLabel* text_label(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  label->setTextFormat(Qt::PlainText);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  // Long names of files must not widen the panel.
  label->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Minimum);
  return label;
}

void show_text(QLabel* label, const std::string& text, const QString& colour) {
  label->setText(QString::fromStdString(text));
  const QString style = "color: " + colour;
  if (label->styleSheet() != style) label->setStyleSheet(style);
}

}  // namespace anthrob
