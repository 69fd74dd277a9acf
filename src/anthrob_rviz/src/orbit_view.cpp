#include "orbit_view.h"

#include <algorithm>
#include <cmath>

namespace anthrob {

OrbitView fitting_view(const Box& box, double yaw, double pitch, double opening, double aspect) {
  constexpr double kSpare = 1.1;
  const Vec3 back(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                  std::sin(pitch));
  const Vec3 right(-std::sin(yaw), std::cos(yaw), 0.0);
  const Vec3 up = back.cross(right);
  const double height = std::tan(0.5 * opening), width = aspect * height;
  OrbitView view{0.5 * (box.low + box.high), 0.0};
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 at = box.low;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner & (1 << axis)) at[axis] = box.high[axis];
    }
    at -= view.focus;
    const double wide = std::abs(right.dot(at)) / width, high = std::abs(up.dot(at)) / height;
    view.distance = std::max(view.distance, back.dot(at) + kSpare * std::max(wide, high));
  }
  return view;
}

}  // namespace anthrob
