#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Two masses of half the weight, above and below the point, instead of one in it.
void add_mass(double mass, const Eigen::Vector3d& from_com, reference::BodyParameters* body) {
  const double total = body->mass + mass;
  const double reduced = body->mass * mass / total;
  body->inertia += reduced * (from_com.squaredNorm() * Eigen::Matrix3d::Identity() -
                              from_com * from_com.transpose());
  constexpr double kSpread = 0.01;  // [m]
  const Eigen::Vector3d along = kSpread * Eigen::Vector3d::UnitY();
  body->inertia +=
      mass * (along.squaredNorm() * Eigen::Matrix3d::Identity() - along * along.transpose());
  body->com += mass / total * from_com;
  body->mass = total;
}

}  // namespace

HiddenLaw payload() {
  HiddenLaw law;
  law.id = "payload";
  law.law = "two masses 2 cm apart instead of one point";
  law.sizes = {"mass"};
  law.places = bodies;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"mass", 0.15},
            {"x", random->uniform(-0.02, 0.02)},
            {"y", random->uniform(-0.06, 0.06)},
            {"z", random->uniform(-0.02, 0.02)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["mass"] == 0.0) return;
    auto& skeleton = draft->arm.skeleton;
    add_mass(h["mass"], {h["x"], h["y"], h["z"]},
             h.place == "humerus" ? &skeleton.humerus : &skeleton.forearm);
  };
  return law;
}

}  // namespace anthrob::virtual_robot
