#pragma once

#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QTableWidget>
#include <map>
#include <memory>
#include <string>

#include "panel/connected_panel.h"

namespace anthrob {

/// Where robot and model part, by muscle or joint and by feed, in colours; and the jobs of the
/// calibration node, with a button that cancels each; and the health of the tendons.
class TwinPanel final : public ConnectedPanel {
 public:
  TwinPanel();  ///< over ROS, see ros/plugins.cpp
  TwinPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

 private:
  /// One line about a job.
  struct JobLine {
    QLabel* text;
    QProgressBar* bar;
    QPushButton* cancel;
  };

  void begin() override;
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;

  void add_job(const std::string& job);
  void show_gaps(const GapReading& reading);
  void show_health(const HealthReading& reading);
  void show_job(const JobReading& job);

  QLabel* state_;
  QLabel* twin_;
  QTableWidget* table_;
  QLabel* health_;
  std::map<std::string, JobLine> jobs_;
  std::map<std::string, Diagnosis> warnings_;  ///< by name, those of the twin
  std::optional<double> heard_gap_;            ///< [s]
};

}  // namespace anthrob
