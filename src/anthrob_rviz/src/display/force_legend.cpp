#include "display/force_legend.h"

#include <QFontMetrics>
#include <QPainter>
#include <cmath>

#include "anthrob_core/force_colour.h"

namespace anthrob {

namespace {

constexpr int kWidth = 230, kHeight = 112, kMargin = 12;  // [pixels]
constexpr int kScaleTop = 34, kScaleHeight = 12;
constexpr int kLetters = 12;

QColor to_qt(const Colour& colour) {
  return QColor::fromRgbF(static_cast<double>(colour.r), static_cast<double>(colour.g),
                          static_cast<double>(colour.b));
}

/// The scale from 0 to its end, with a number at either end and in the middle.
void paint_scale(QPainter& painter, double full_force) {
  const int span = kWidth - 2 * kMargin;
  for (int x = 0; x < span; ++x) {
    const Colour colour = force_colour(full_force * x / (span - 1), full_force);
    painter.fillRect(kMargin + x, kScaleTop, 1, kScaleHeight, to_qt(colour));
  }
  const QRect numbers(kMargin, kScaleTop + kScaleHeight + 2, span, kLetters + 6);
  painter.drawText(numbers, Qt::AlignLeft, "0");
  painter.drawText(numbers, Qt::AlignHCenter, QString::number(0.5 * full_force));
  painter.drawText(numbers, Qt::AlignRight, QString::number(full_force) + " N");
}

void paint_sample(QPainter& painter, int left, int thickness, const QColor& colour,
                  const QString& text) {
  const int middle = kHeight - kMargin - kLetters / 2;
  painter.fillRect(left, middle - thickness / 2, 22, thickness, colour);
  painter.drawText(QRect(left + 28, middle - kLetters, kWidth, 2 * kLetters), Qt::AlignVCenter,
                   text);
}

}  // namespace

QImage force_legend(double full_force, const Theme& theme) {
  QImage image(kWidth, kHeight, QImage::Format_ARGB32);
  image.fill(theme.legend);  // so that it can be read over the robot
  QPainter painter(&image);
  QFont font("Sans");
  font.setPixelSize(kLetters);
  painter.setFont(font);
  painter.setPen(theme.text);
  painter.drawText(QRect(kMargin, 0, kWidth, kScaleTop), Qt::AlignVCenter, "Force of tendons");
  paint_scale(painter, full_force);
  paint_sample(painter, kMargin, 6, to_qt(force_colour(std::nan(""))), "not measured");
  paint_sample(painter, kMargin + 130, 2, to_qt(force_colour(0.0)), "slack");
  return image;
}

}  // namespace anthrob
