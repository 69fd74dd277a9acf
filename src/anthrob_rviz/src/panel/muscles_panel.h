#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QVBoxLayout>
#include <memory>
#include <string>
#include <vector>

#include "command_thread.h"
#include "diagnostics.h"
#include "muscle_board.h"
#include "muscle_groups.h"
#include "panel/connected_panel.h"
#include "panel/muscle_row_widget.h"

namespace anthrob {

/// Shows a robot's muscles, and commands those whose slider is held down or whose hold is ticked.
class MusclesPanel final : public ConnectedPanel {
 public:
  MusclesPanel();  ///< over ROS, see ros/plugins.cpp
  MusclesPanel(std::unique_ptr<RobotConnection> connection, const std::string& robot);

 private:
  void end() override;
  void begin() override;
  void hear(const News& news, double now) override;
  void act(double now) override;
  void refresh(double now) override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

  void add_buttons();
  void add_list();
  void make_rows();
  void filter();
  void show_groups(double now);
  void show_status(double now);
  std::string remark_of(const MuscleRow& row, double now) const;
  std::string last_rejection(double now) const;

  MuscleBoard board_;
  Diagnostics diagnostics_;
  QLabel* status_;
  QLineEdit* search_;
  QComboBox* group_;
  QCheckBox* hold_all_;
  QVBoxLayout* list_;
  std::vector<MuscleRowWidget*> rows_;
  std::vector<MuscleGroup> antagonists_, groups_;
  CommandThread commands_;
};

}  // namespace anthrob
