#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QWidget>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scope/scope_model.h"
#include "scope/trigger.h"

namespace anthrob {

/// When the oscilloscope takes its picture, and of which curve.
struct TriggerChoice {
  std::string path;
  Trigger trigger;
  bool single = false;  ///< frozen after the first picture
};

class TriggerBar final : public QWidget {
 public:
  explicit TriggerBar(QWidget* parent = nullptr);

  /// Offers the ticked quantities.
  void offer(const std::vector<Curve>& curves);
  TriggerChoice choice() const;
  void choose(const TriggerChoice& choice);
  void on_change(std::function<void()> call) { on_change_ = std::move(call); }

 private:
  void changed();

  QComboBox* quantity_;
  QComboBox* edge_;
  QDoubleSpinBox* level_;
  QDoubleSpinBox* width_;
  QDoubleSpinBox* pre_;
  QCheckBox* single_;
  std::string wanted_;  ///< of a layout, until it is there
  bool offering_ = false;
  std::function<void()> on_change_;
};

}  // namespace anthrob
