#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFrame>
#include <QLabel>
#include <QProgressBar>
#include <QSlider>
#include <QStackedWidget>
#include <functional>
#include <string>

#include "muscle_row.h"

namespace anthrob {

/// One muscle: on two lines its state, name, mode, number and hold, and below them slider,
/// reference, measurement and force; on a third one, if there is one, what its user should know.
class MuscleRowWidget final : public QFrame {
 public:
  /// @param row finds the muscle's row, which may have moved
  explicit MuscleRowWidget(const std::string& name, std::function<MuscleRow&()> row);

  /// @param remark beside the row's own; may be empty
  void show_row(bool fresh, const std::string& remark, double force_limit);
  /// As if its user had let go.
  void let_go();
  const QString& name() const { return name_; }

 private:
  void lay_out();
  void listen();
  void show_light(Light light);
  void show_target();
  void show_numbers(double force_limit);
  void show_remark(const std::string& remark);
  bool eventFilter(QObject* watched, QEvent* event) override;

  QString name_;
  std::function<MuscleRow&()> row_;
  QLabel* light_;
  QLabel* state_;
  QComboBox* mode_;
  QDoubleSpinBox* number_;
  QCheckBox* hold_;
  QSlider* slider_;
  QLabel* values_;
  QProgressBar* force_;
  QLabel* remark_;
  QStackedWidget* lines_;  ///< numbers, or the remark
};

}  // namespace anthrob
