#pragma once

#include <QApplication>
#include <QMouseEvent>
#include <QSlider>
#include <QStyle>
#include <QStyleOptionSlider>
#include <QTest>
#include <QWidget>

namespace anthrob {

/// The application of a test program, without a screen.
inline void begin_application() {
  if (QApplication::instance() != nullptr) return;
  qputenv("QT_QPA_PLATFORM", "offscreen");
  static int argc = 1;
  static char name[] = "test";
  static char* argv[] = {name, nullptr};
  static QApplication application(argc, argv);
}

template <class Widget>
Widget* child(const QWidget* parent, const char* name) {
  return parent->findChild<Widget*>(name);
}

/// The middle of a slider's handle.
inline QPoint handle_of(const QSlider* slider) {
  QStyleOptionSlider option;
  option.initFrom(slider);
  option.minimum = slider->minimum(), option.maximum = slider->maximum();
  option.sliderPosition = slider->sliderPosition(), option.sliderValue = slider->value();
  return slider->style()
      ->subControlRect(QStyle::CC_Slider, &option, QStyle::SC_SliderHandle, slider)
      .center();
}

/// Moves the mouse, whose button is down on the handle. (QTest::mouseMove moves the screen's
/// cursor, of which a program without a screen does not learn.)
inline void drag(QSlider* slider, int pixels) {
  const QPoint to = handle_of(slider) + QPoint(pixels, 0);
  QMouseEvent move(QEvent::MouseMove, to, slider->mapToGlobal(to), Qt::NoButton, Qt::LeftButton,
                   Qt::NoModifier);
  QApplication::sendEvent(slider, &move);
}

}  // namespace anthrob
