#include "panel/play_panel.h"

#include <QHBoxLayout>
#include <cmath>

namespace anthrob {
namespace {

constexpr int kBarTicks = 10000;    // finer than any screen
constexpr double kCallLimit = 2.0;  // [s] of a call
constexpr double kSpeaks = 1.0;     // [s] a player speaks 20 times a second

const char* const kNobody =
    "no recording is played here: roslaunch anthrob_bringup play.launch bag:=$PWD/run.bag";

}  // namespace

PlayPanel::PlayPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot)
    : ConnectedPanel(std::move(connection), robot),
      file_(text_label("file")),
      place_(new QLabel),
      answer_(text_label("answer")),
      bar_(new QSlider(Qt::Horizontal)),
      pause_(new QPushButton("Pause")),
      rate_(new QDoubleSpinBox) {
  column()->addWidget(file_);
  add_bar();
  add_buttons();
  column()->addWidget(answer_);
  column()->addStretch(1);
}

void PlayPanel::add_bar() {
  bar_->setObjectName("bar");
  bar_->setRange(0, kBarTicks);
  bar_->setPageStep(kBarTicks / 20);
  bar_->setSingleStep(kBarTicks / 200);
  bar_->setToolTip("Drag to go to any place of the recording");
  connect(bar_, &QSlider::actionTriggered, this, [this] {
    if (player_) wanted_ = player_->duration * bar_->sliderPosition() / kBarTicks;
  });
  column()->addWidget(bar_);
}

void PlayPanel::add_buttons() {
  auto* line = new QHBoxLayout;
  pause_->setObjectName("pause");
  connect(pause_, &QPushButton::clicked, this, [this] {
    if (player_) connection().call({"player/pause", kCallLimit, !player_->paused});
  });
  rate_->setObjectName("rate");
  rate_->setRange(0.01, 100.0);
  rate_->setPrefix("x ");
  rate_->setKeyboardTracking(false);
  rate_->setToolTip("Factor of the recorded speed");
  connect(rate_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this](double rate) {
    ServiceRequest request{"player/set_rate", kCallLimit};
    request.factor = rate;
    connection().call(request);
  });
  place_->setObjectName("place");
  place_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  line->addWidget(pause_);
  line->addWidget(rate_);
  line->addWidget(place_, 1);
  column()->addLayout(line);
}

void PlayPanel::begin() {
  player_.reset();
  wanted_.reset();
  answer_->clear();
}

void PlayPanel::hear(const News& news, double now) {
  if (news.player) player_ = news.player, heard_ = now;
  for (const CallResult& answer : news.answers) {
    const std::string text = answer.success ? "" : answer.service + ": failed, " + answer.message;
    show_text(answer_, text, colour_of(Level::kError));
  }
}

void PlayPanel::act(double now) {
  if (player_ && now - heard_ > kSpeaks) begin();
  if (!wanted_) return;
  ServiceRequest request{"player/seek", kCallLimit};
  request.position = *wanted_;
  // The last place counts: while a call is under way, it waits.
  if (connection().call(request)) wanted_.reset();
}

void PlayPanel::refresh(double) {
  for (QWidget* widget :
       {static_cast<QWidget*>(bar_), static_cast<QWidget*>(pause_), static_cast<QWidget*>(rate_)}) {
    widget->setEnabled(player_.has_value());
  }
  if (player_) return show_player(*player_);
  show_text(file_, kNobody, colour_of(Level::kWarning));
  place_->clear();
}

void PlayPanel::show_player(const PlayerReading& player) {
  show_text(file_, player.bag, colour_of(Level::kOk));
  place_->setText(
      QString("%1 of %2 s").arg(player.position, 0, 'f', 2).arg(player.duration, 0, 'f', 2));
  pause_->setText(player.paused ? "Play" : "Pause");
  if (!bar_->isSliderDown() && !wanted_ && player.duration > 0.0) {
    bar_->setValue(static_cast<int>(std::lround(kBarTicks * player.position / player.duration)));
  }
  if (rate_->hasFocus()) return;
  const bool blocked = rate_->blockSignals(true);
  rate_->setValue(player.rate);
  rate_->blockSignals(blocked);
}

}  // namespace anthrob
