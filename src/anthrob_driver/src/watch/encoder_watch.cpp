#include "watch/encoder_watch.h"

#include <cmath>
#include <cstdio>

namespace anthrob {
namespace driver {

std::optional<std::string> EncoderWatch::step(double position, double voltage, double current,
                                              double now) {
  if (resistance_ <= 0.0 || back_emf_ <= 0.0) return std::nullopt;
  const double drop = resistance_ * current, emf = voltage - drop;
  const bool turns = std::abs(emf) > kLeast + kHot * std::abs(drop);
  const int direction = !turns ? 0 : emf > 0.0 ? 1 : -1;
  if (direction != turning_ || now - last_ > kLongestGap) {
    turning_ = direction;
    since_ = now;
    start_ = position;
    turned_ = 0.0;
  } else if (direction != 0) {
    turned_ += emf / back_emf_ * (now - last_);
  }
  last_ = now;
  if (direction == 0 || now - since_ < kLasts) return std::nullopt;
  const double counted = position - start_;
  const double turned = turned_;
  turning_ = 0;  // looked at; anew from the next measurement on
  if (counted / turned >= kCounted) return std::nullopt;
  char text[160];
  std::snprintf(text, sizeof(text),
                "at %.1f V and %.2f A its motor must have turned by %.2f rad, but the encoder "
                "counted %.3f rad",
                voltage, current, turned, counted);
  return text;
}

}  // namespace driver
}  // namespace anthrob
