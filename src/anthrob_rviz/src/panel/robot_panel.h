#pragma once

#include <QLineEdit>
#include <QPushButton>
#include <QSpinBox>
#include <memory>
#include <string>

#include "diagnostics.h"
#include "panel/connected_panel.h"
#include "panel/diagnostics_tree.h"
#include "panel/stop_key.h"

namespace anthrob {

/// Enables, stops, clears and homes a robot, stops and steps the time of its simulator, and shows
/// its diagnostics.
class RobotPanel final : public ConnectedPanel {
 public:
  RobotPanel();  ///< over ROS, see ros/plugins.cpp
  RobotPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

  void stop();

 private:
  void begin() override;
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;

  void add_stop();
  void add_services();
  void add_simulator();
  void add_steps(QVBoxLayout* lines);
  void add_rate(QVBoxLayout* lines);
  void add_snapshots(QVBoxLayout* lines);
  QPushButton* add_button(QLayout* line, const char* text, const char* name,
                          const ServiceRequest& request);
  void call(const ServiceRequest& request);
  void note(const CallResult& answer);
  void show_state(double now);
  void show_simulator(double now);

  Diagnostics diagnostics_;
  QLabel* state_;
  QLabel* answer_;
  QWidget* simulator_;
  QLabel* real_time_;
  QSpinBox* steps_;
  QDoubleSpinBox* rate_;
  QLineEdit* snapshot_;
  DiagnosticsTree* tree_;
  StopKey key_;
};

}  // namespace anthrob
