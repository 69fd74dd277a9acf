#pragma once

#include <QDoubleSpinBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <memory>
#include <optional>
#include <string>

#include "panel/connected_panel.h"

namespace anthrob {

/// The time bar of a recording that is played: pauses it, goes to any place of it, sets its speed.
class PlayPanel final : public ConnectedPanel {
 public:
  PlayPanel();  ///< over ROS, see ros/plugins.cpp
  PlayPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

 private:
  void begin() override;
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;

  void add_bar();
  void add_buttons();
  void show_player(const PlayerReading& player);

  std::optional<PlayerReading> player_;
  double heard_ = 0.0;            ///< [s] when the player last spoke
  std::optional<double> wanted_;  ///< [s] place that the mouse asks for
  QLabel *file_, *place_, *answer_;
  QSlider* bar_;
  QPushButton* pause_;
  QDoubleSpinBox* rate_;
};

}  // namespace anthrob
