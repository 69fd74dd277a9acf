#pragma once

#include <QObject>
#include <functional>

namespace anthrob {

/// Calls a stop when the space bar is pressed anywhere in the program, whatever has the focus: also
/// in a dialog, and while the panel is hidden. In a field of text the space is typed, too. (A
/// QShortcut is deaf in all of these.)
class StopKey final : public QObject {
 public:
  explicit StopKey(std::function<void()> stop);

 private:
  bool eventFilter(QObject* watched, QEvent* event) override;

  std::function<void()> stop_;
};

}  // namespace anthrob
