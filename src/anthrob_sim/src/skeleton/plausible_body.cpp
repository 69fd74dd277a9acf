#include "skeleton/plausible_body.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "anthrob_core/text.h"

namespace anthrob {

namespace {

/// Rounding of the numbers in a file, relative to the sum of the moments; as of bodies
/// (BodyModel::find_principal_axes).
constexpr double kRounding = 1e-6;

/// No link is so large that its mass lies 10 m from its centre; no point of a muscle's path lies
/// farther either (loading/). Inertias in kg mm^2 or g cm^2 make it a thousand times the true one.
constexpr double kLargestRadius = 10.0;  // [m]

/// A rod has a radius of gyration of 0.29 of its length: this one would be 4 m long. Inertias in
/// kg cm^2 make the radius a hundred times the true one, which is 1 cm or more for a finger.
constexpr double kOddRadius = 1.2;  // [m]

/// A body within a distance d of its link's origin has a radius of gyration below 2 d. What is
/// known of a link (centre of mass, joints on it, its shapes) may be half of it, and the rotor of a
/// geared motor adds to its inertia.
constexpr double kOddRadiusOfExtent = 5.0;

/// The heaviest link of the suite's robots (a carriage with its screw and rotor) has 95 kg.
constexpr double kOddMass = 100.0;  // [kg]

/// Of osmium, the densest metal [kg/m^3]. Of all bodies of one mass a ball has the least sum of
/// principal moments, 6/5 m r^2.
constexpr double kLargestDensity = 22590.0;

/// Below this share of the ball of osmium a link is odd. Effective masses, to which rotors add,
/// come down to 0.26 in the suite's robots; a mass in grams to 1e-3 or less.
constexpr double kOddShareOfBall = 0.01;

/// Radius of gyration of a link of which no size is known [m]: a rod of 0.25 m.
constexpr double kUsualRadius = 0.07;

/// Of a rod that begins at its link's origin, in its length.
constexpr double kUsualRadiusOfExtent = 0.3;

}  // namespace

PlausibleBody::PlausibleBody(double mass, const Mat3& inertia, double extent)
    : mass_(mass),
      extent_(extent),
      principal_(
          Eigen::SelfAdjointEigenSolver<Mat3>(inertia, Eigen::EigenvaluesOnly).eigenvalues()) {}

double PlausibleBody::radius_of_gyration() const {
  return mass_ > 0.0 ? std::sqrt(std::max(0.0, principal_[2]) / mass_) : 0.0;
}

std::optional<std::string> PlausibleBody::impossible() const {
  if (!(mass_ >= 0.0) || !std::isfinite(mass_)) {
    return "mass: " + short_number(mass_) + ": expected a number >= 0 [kg]";
  }
  const double slack = kRounding * principal_.cwiseAbs().sum();
  const bool is_of_a_body =
      principal_[0] >= -slack && principal_[2] <= principal_[0] + principal_[1] + slack;
  if (!is_of_a_body) {
    return "inertia: principal moments " + significant(principal_[0], 4) + ", " +
           significant(principal_[1], 4) + ", " + significant(principal_[2], 4) +
           ": expected none below 0 and none larger than the other two together [kg m^2]";
  }
  if (radius_of_gyration() > kLargestRadius) {
    return inertia_text() + ": expected at most " + short_number(kLargestRadius) +
           " m: " + likely_unit();
  }
  return std::nullopt;
}

std::optional<std::string> PlausibleBody::odd() const {
  const double radius = radius_of_gyration();
  if (radius > kOddRadius) return inertia_text() + ": that is a large link: " + likely_unit();
  if (extent_ > 0.0 && radius > kOddRadiusOfExtent * extent_) {
    return inertia_text() + " of a link that reaches " + short_number(extent_) +
           " m: " + likely_unit();
  }
  if (is_denser_than_matter()) {
    return "inertia: " + short_number(principal_[2]) + " kg m^2 of " + short_number(mass_) +
           " kg: a ball of the densest metal has more: mass in g?";
  }
  if (mass_ > kOddMass) return "mass: " + short_number(mass_) + " kg: in g?";
  if (mass_ == 0.0 && principal_[2] > 0.0) {
    return std::string("mass: 0 with an inertia: expected both, or none");
  }
  return std::nullopt;
}

/// A point mass without inertia is meant to be one.
bool PlausibleBody::is_denser_than_matter() const {
  const double sum = principal_.sum();
  if (!(sum > 0.0) || !(mass_ > 0.0)) return false;
  const double radius = std::cbrt(3.0 * mass_ / (4.0 * M_PI * kLargestDensity));
  return sum < kOddShareOfBall * 1.2 * mass_ * radius * radius;
}

std::string PlausibleBody::inertia_text() const {
  return "inertia: " + short_number(principal_[2]) + " kg m^2 of " + short_number(mass_) +
         " kg (radius of gyration " + short_number(radius_of_gyration()) + " m)";
}

/// The unit in which the number would be that of a usual link.
std::string PlausibleBody::likely_unit() const {
  struct Unit {
    const char* question;
    double size;  ///< [kg m^2]
  };
  const Unit units[] = {
      {"in kg cm^2?", 1e-4}, {"in kg mm^2?", 1e-6}, {"in g cm^2?", 1e-7}, {"in g mm^2?", 1e-9}};
  const double usual = extent_ > 0.0 ? kUsualRadiusOfExtent * extent_ : kUsualRadius;
  const Unit* best = &units[0];
  const auto distance = [&](const Unit& unit) {
    return std::abs(std::log(radius_of_gyration() * std::sqrt(unit.size) / usual));
  };
  for (const Unit& unit : units) {
    if (distance(unit) < distance(*best)) best = &unit;
  }
  return best->question;
}

}  // namespace anthrob
