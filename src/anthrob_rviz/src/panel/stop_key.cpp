#include "panel/stop_key.h"

#include <QApplication>
#include <QKeyEvent>
#include <QWidget>
#include <utility>

namespace anthrob {

StopKey::StopKey(std::function<void()> stop) : stop_(std::move(stop)) {
  QApplication::instance()->installEventFilter(this);
}

bool StopKey::eventFilter(QObject* watched, QEvent* event) {
  // A key goes to the window first, and then to a widget.
  if (event->type() != QEvent::KeyPress || !watched->isWidgetType()) return false;
  const auto* key = static_cast<QKeyEvent*>(event);
  const bool plain = (key->modifiers() & ~Qt::ShiftModifier) == Qt::NoModifier;
  if (key->key() != Qt::Key_Space || !plain) return false;
  if (!key->isAutoRepeat()) stop_();
  const bool takes_text = static_cast<QWidget*>(watched)->testAttribute(Qt::WA_InputMethodEnabled);
  // Otherwise the space would also press the button that has the focus: Enable, for example.
  return !takes_text;
}

}  // namespace anthrob
