#pragma once

#include <QColor>

namespace anthrob {

/// Colours of what lies behind the robot, and of what is written over it.
struct Theme {
  QColor background, text;
  QColor legend;  ///< ground of the legend, through which the robot can still be seen
};

inline Theme dark_theme() {
  return {QColor(38, 40, 44), Qt::white, QColor(24, 26, 30, 200)};
}
inline Theme light_theme() {
  return {QColor(246, 247, 249), QColor(20, 22, 26), QColor(255, 255, 255, 200)};
}

}  // namespace anthrob
