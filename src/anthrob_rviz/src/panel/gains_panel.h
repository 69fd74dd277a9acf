#pragma once

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "gains/gain_table.h"
#include "panel/connected_panel.h"

namespace anthrob {

/// Changes the gains of the muscles' control laws while the motors run, takes changes back, and
/// saves what the robot holds as a model file.
class GainsPanel final : public ConnectedPanel {
 public:
  GainsPanel();  ///< over ROS, see ros/plugins.cpp
  GainsPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

  /// What the dialog asks for.
  void save_as(const std::string& file);

 private:
  /// What is to be asked next. The robot takes one request at a time.
  struct Request {
    GainTable::Why why = GainTable::Why::kRead;
    std::vector<Gain> gains;
  };
  struct Row {
    std::string name;
    QDoubleSpinBox* number;
    QLabel* remark;
  };

  void begin() override;
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

  void add_buttons();
  void take(const CallResult& answer);
  void make_rows();
  void add_row(const std::string& name);
  void choose_file();
  void show_row(const Row& row);
  void note(const CallResult& answer);
  /// Empty: all.
  std::string muscle() const;

  GainTable table_;
  std::deque<Request> requests_;
  Request asked_;
  bool waiting_ = false;
  double next_read_ = 0.0;
  QLabel* state_;
  QComboBox* muscle_;
  QPushButton* undo_;
  QGridLayout* grid_;
  QLabel* answer_;
  std::vector<Row> rows_;
};

}  // namespace anthrob
