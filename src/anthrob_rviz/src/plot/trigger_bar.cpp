#include "plot/trigger_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <cmath>

namespace anthrob {
namespace {

QDoubleSpinBox* number_box(const char* name, double least, double greatest, double value,
                           const char* unit) {
  auto* box = new QDoubleSpinBox;
  box->setObjectName(name);
  box->setRange(least, greatest);
  box->setDecimals(3);
  box->setValue(value);
  box->setSuffix(unit);
  box->setKeyboardTracking(false);
  return box;
}

}  // namespace

TriggerBar::TriggerBar(QWidget* parent)
    : QWidget(parent),
      quantity_(new QComboBox),
      edge_(new QComboBox),
      level_(number_box("trigger_level", -1e9, 1e9, 0.0, "")),
      width_(number_box("trigger_width", 0.001, 60.0, 1.0, " s")),
      pre_(number_box("trigger_pre", 0.0, 100.0, 20.0, " %")),
      single_(new QCheckBox("single")) {
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(0, 0, 0, 0);
  quantity_->setObjectName("trigger_quantity");
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  quantity_->setMinimumContentsLength(18);
  edge_->setObjectName("trigger_edge");
  edge_->addItems({"rises above", "falls below", "crosses"});
  single_->setObjectName("trigger_single");
  single_->setToolTip("Freezes after the first picture");
  width_->setToolTip("Width of the picture");
  pre_->setToolTip("Share of the picture that lies before the crossing");
  line->addWidget(new QLabel("when"));
  line->addWidget(quantity_, 1);
  line->addWidget(edge_);
  line->addWidget(level_);
  line->addWidget(new QLabel("show"));
  line->addWidget(width_);
  line->addWidget(new QLabel("before it"));
  line->addWidget(pre_);
  line->addWidget(single_);
  for (QComboBox* box : {quantity_, edge_}) {
    connect(box, QOverload<int>::of(&QComboBox::currentIndexChanged), this, [this] { changed(); });
  }
  for (QDoubleSpinBox* box : {level_, width_, pre_}) {
    connect(box, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this, [this] { changed(); });
  }
  connect(single_, &QCheckBox::toggled, this, [this] { changed(); });
}

void TriggerBar::changed() {
  if (offering_) return;
  wanted_ = quantity_->currentText().toStdString();
  if (on_change_) on_change_();
}

void TriggerBar::offer(const std::vector<Curve>& curves) {
  QStringList paths;
  for (const Curve& curve : curves) {
    const QString path = QString::fromStdString(curve.quantity.path);
    if (!paths.contains(path)) paths << path;
  }
  QStringList offered;
  for (int i = 0; i < quantity_->count(); ++i) offered << quantity_->itemText(i);
  if (offered == paths) return;
  offering_ = true;
  quantity_->clear();
  quantity_->addItems(paths);
  const int index = quantity_->findText(QString::fromStdString(wanted_));
  if (index >= 0) quantity_->setCurrentIndex(index);
  offering_ = false;
}

TriggerChoice TriggerBar::choice() const {
  TriggerChoice choice;
  choice.path = quantity_->currentText().toStdString();
  choice.trigger.level = level_->value();
  choice.trigger.edge = static_cast<Trigger::Edge>(edge_->currentIndex());
  choice.trigger.width = std::llround(1e9 * width_->value());
  choice.trigger.pre = pre_->value() / 100.0;
  choice.single = single_->isChecked();
  return choice;
}

void TriggerBar::choose(const TriggerChoice& choice) {
  offering_ = true;
  wanted_ = choice.path;
  const int index = quantity_->findText(QString::fromStdString(wanted_));
  if (index >= 0) quantity_->setCurrentIndex(index);
  level_->setValue(choice.trigger.level);
  edge_->setCurrentIndex(static_cast<int>(choice.trigger.edge));
  width_->setValue(1e-9 * static_cast<double>(choice.trigger.width));
  pre_->setValue(100.0 * choice.trigger.pre);
  single_->setChecked(choice.single);
  offering_ = false;
}

}  // namespace anthrob
