#include "panel/muscle_row_widget.h"

#include <QEvent>
#include <QGridLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <utility>

#include "panel/connected_panel.h"
#include "slider_scale.h"

namespace anthrob {
namespace {

QString number_text(double value) {
  if (!std::isfinite(value)) return "-";
  const QString text = QString::number(value, 'f', 2);
  return text == "-0.00" ? QString("0.00") : text;
}

QString colour_of_light(Light light) {
  switch (light) {
    case Light::kEnabled:
      return colour_of(Level::kOk);
    case Light::kFault:
      return colour_of(Level::kError);
    case Light::kStale:
      return colour_of(Level::kStale);
    case Light::kDisabled:
      break;
  }
  return "#b0b0b0";
}

QString text_of_light(Light light, EcuState state) {
  return light == Light::kStale ? QString("stale") : QString::fromStdString(name_of(state));
}

}  // namespace

MuscleRowWidget::MuscleRowWidget(const std::string& name, std::function<MuscleRow&()> row)
    : name_(QString::fromStdString(name)),
      row_(std::move(row)),
      light_(new QLabel),
      state_(new QLabel),
      mode_(new QComboBox),
      number_(new QDoubleSpinBox),
      hold_(new QCheckBox("hold")),
      slider_(new QSlider(Qt::Horizontal)),
      values_(new QLabel),
      force_(new QProgressBar),
      remark_(new QLabel),
      lines_(new QStackedWidget) {
  setObjectName(name_);
  lay_out();
  listen();
}

void MuscleRowWidget::lay_out() {
  setFrameShape(QFrame::StyledPanel);
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(6, 1, 6, 1);
  grid->setVerticalSpacing(0);
  grid->setHorizontalSpacing(6);
  light_->setFixedSize(14, 14);
  auto* name = new QLabel("<b>" + name_ + "</b>");
  state_->setObjectName("state");
  grid->addWidget(light_, 0, 0);
  grid->addWidget(name, 0, 1);
  grid->addWidget(state_, 0, 2);
  grid->addWidget(mode_, 0, 3);
  grid->addWidget(hold_, 0, 4);
  grid->addWidget(slider_, 1, 0, 1, 3);
  grid->addWidget(number_, 1, 3);
  grid->addWidget(force_, 1, 4);
  for (QLabel* line : {values_, remark_})
    line->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  lines_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  lines_->addWidget(values_);
  lines_->addWidget(remark_);
  grid->addWidget(lines_, 2, 0, 1, 5);
  grid->setColumnStretch(2, 1);
}

void MuscleRowWidget::listen() {
  for (const ControlMode mode : kControlModes)
    mode_->addItem(QString::fromStdString(name_of(mode)));
  mode_->setObjectName("mode");
  number_->setObjectName("number");
  number_->setDecimals(2);
  number_->setKeyboardTracking(false);  // "12" is not 1 first
  hold_->setObjectName("hold");
  hold_->setToolTip("Repeats this command 20 times a second");
  slider_->setObjectName("slider");
  slider_->setRange(0, SliderScale::kSteps);
  slider_->setPageStep(SliderScale::kSteps / 100);
  slider_->setToolTip("Commands while it is held down, or while hold is ticked");
  values_->setObjectName("values");
  QFont small = values_->font();
  small.setPointSizeF(0.85 * small.pointSizeF());
  values_->setFont(small);
  remark_->setObjectName("remark");
  remark_->setFont(small);
  remark_->setStyleSheet("color: " + colour_of(Level::kError));
  force_->setObjectName("force");
  force_->setFixedWidth(84);
  force_->setToolTip("Measured force");
  for (QWidget* widget : {static_cast<QWidget*>(mode_), static_cast<QWidget*>(number_),
                          static_cast<QWidget*>(slider_)}) {
    widget->installEventFilter(this);
    widget->setFocusPolicy(Qt::StrongFocus);
  }
  connect(mode_, QOverload<int>::of(&QComboBox::activated), this,
          [this](int i) { row_().set_mode(kControlModes.at(static_cast<std::size_t>(i))); });
  connect(number_, QOverload<double>::of(&QDoubleSpinBox::valueChanged), this,
          [this](double value) { row_().set_target(value); });
  connect(hold_, &QCheckBox::toggled, this, [this](bool held) { row_().hold(held); });
  connect(slider_, &QSlider::sliderPressed, this, [this] { row_().press(); });
  connect(slider_, &QSlider::sliderReleased, this, [this] { row_().release(); });
  connect(slider_, &QSlider::valueChanged, this,
          [this](int step) { row_().set_target(SliderScale(row_().range()).value(step)); });
}

/// The wheel scrolls the list, and moves no muscle on its way.
bool MuscleRowWidget::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::Wheel) return QFrame::eventFilter(watched, event);
  event->ignore();
  return true;
}

void MuscleRowWidget::let_go() {
  slider_->setSliderDown(false);
}

void MuscleRowWidget::show_row(bool fresh, const std::string& remark, double force_limit) {
  show_light(row_().light(fresh));
  show_target();
  show_numbers(force_limit);
  show_remark(remark);
}

void MuscleRowWidget::show_light(Light light) {
  const QString colour = colour_of_light(light);
  const QString style = "border-radius: 7px; background: " + colour;
  if (light_->styleSheet() != style) light_->setStyleSheet(style);
  const QString text = text_of_light(light, row_().reading().state);
  light_->setToolTip(text);
  show_text(state_, text.toStdString(),
            light == Light::kDisabled ? colour_of(Level::kStale) : colour);
}

void MuscleRowWidget::show_target() {
  const MuscleRow& row = row_();
  const QSignalBlocker quiet_mode(mode_), quiet_number(number_), quiet_hold(hold_),
      quiet_slider(slider_);
  const auto* const at = std::find(kControlModes.begin(), kControlModes.end(), row.mode());
  mode_->setCurrentIndex(static_cast<int>(at - kControlModes.begin()));
  hold_->setChecked(row.held());
  // A number that is typed while nothing is sent would be a jump later on.
  number_->setReadOnly(!row.held());
  number_->setButtonSymbols(row.held() ? QAbstractSpinBox::UpDownArrows
                                       : QAbstractSpinBox::NoButtons);
  number_->setSuffix(" " + QString::fromStdString(unit_of(row.mode())));
  number_->setRange(row.range().low, row.range().high);
  if (!number_->hasFocus() || !row.held()) number_->setValue(row.target());
  if (!slider_->isSliderDown()) slider_->setValue(SliderScale(row.range()).step(row.target()));
}

void MuscleRowWidget::show_numbers(double force_limit) {
  const MuscleReading& reading = row_().reading();
  values_->setText(QString("reference %1 %2    position %3 rad    voltage %4 V")
                       .arg(number_text(reading.reference),
                            QString::fromStdString(unit_of_message_mode(reading.mode)),
                            number_text(reading.position), number_text(reading.voltage)));
  const bool known = std::isfinite(reading.force);
  constexpr int kBarSteps = 100;
  const double share = known ? reading.force / force_limit : 0.0;
  force_->setRange(0, kBarSteps);
  force_->setValue(static_cast<int>(std::lround(kBarSteps * std::min(std::max(share, 0.0), 1.0))));
  force_->setFormat(known ? number_text(reading.force) + " N" : QString("no sensor"));
}

/// In the place of the numbers, because rows that grow would move other sliders under the mouse.
void MuscleRowWidget::show_remark(const std::string& remark) {
  const QString text = QString::fromStdString(remark);
  const int width = values_->contentsRect().width();
  remark_->setText(remark_->fontMetrics().elidedText(text, Qt::ElideRight, width));
  remark_->setToolTip(text);
  lines_->setCurrentWidget(remark.empty() ? values_ : remark_);
  if (!remark.empty()) light_->setToolTip(text);
}

}  // namespace anthrob
