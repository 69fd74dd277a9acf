#include "path/undecided_side.h"

#include <vector>

namespace anthrob {

namespace {

/// A point that is moved so little does not lead a tendon elsewhere: table values are rounded to
/// 0.1 mm, and no lathe is as exact [m].
constexpr double kHardlyMoved = 1e-6;
/// The tendon meets the surface so far away [m]: it has gone to another side. Where it only begins
/// to touch, the place moves by the root of the way, 0.2 mm on a radius of 20 mm.
constexpr double kElsewhere = 1e-3;

WrapContact contact_of(const WrappingSurface& surface, const Vec3& before, const Vec3& after) {
  std::vector<double> memory(surface.state_size() + 1, 0.0);
  WrapContact contact;
  surface.initialise(before, after, StateView(memory.data()));
  surface.wrap(before, after, StateView(memory.data()), contact);
  return contact;
}

double length_of(const WrapContact& contact) {
  return contact.length_in + contact.length_on + contact.length_out;
}

}  // namespace

std::optional<std::pair<double, double>> undecided_side(const WrappingSurface& surface,
                                                        const Vec3& before, const Vec3& after) {
  if (surface.type() == "mesh") return std::nullopt;
  const WrapContact here = contact_of(surface, before, after);
  if (!here.touching) return std::nullopt;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double way : {-kHardlyMoved, kHardlyMoved}) {
      const WrapContact there = contact_of(surface, before, after + way * Vec3::Unit(axis));
      if (!there.touching || (there.entry - here.entry).norm() < kElsewhere) continue;
      return std::make_pair(length_of(here), length_of(there));
    }
  }
  return std::nullopt;
}

}  // namespace anthrob
