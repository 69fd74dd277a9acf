#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <memory>
#include <string>

#include "panel/connected_panel.h"

namespace anthrob {

/// Records a bag of the robot, by the recorder of ROS. When the panel or RViz ends, the bag is
/// closed, and whole.
class RecordPanel final : public ConnectedPanel {
 public:
  RecordPanel();  ///< over ROS, see ros/plugins.cpp
  RecordPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);
  ~RecordPanel() override;

 private:
  /// Gets SIGINT, and so closes its bag, if RViz dies.
  class Recorder final : public QProcess {
    void setupChildProcess() override;
  };

  void end() override;
  void begin() override {}
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;

  void add_fields();
  void toggle();
  void start();
  void interrupt();
  /// Waits until the bag is closed.
  void finish();
  void ended();
  void tell(const std::string& text, Level level);
  bool records() const { return recorder_.state() != QProcess::NotRunning; }

  QLabel* state_;
  QLineEdit* file_;
  QComboBox* what_;
  QSpinBox* duration_;
  QPushButton* button_;
  QLabel* answer_;
  Recorder recorder_;
  std::string bag_;     ///< that is written
  double began_ = 0.0;  ///< [s]
};

}  // namespace anthrob
