#include "skeleton/urdf_sizes.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <optional>
#include <sstream>

#include "anthrob_core/text.h"
#include "skeleton/plausible_body.h"

namespace anthrob {

namespace {

using tinyxml2::XMLElement;

/// No part of a link lies farther from its frame than a point of a muscle's path may (loading/).
/// Lengths in millimetres come to this from 1 cm on.
constexpr double kFarthest = 10.0;  // [m]

/// The longest way between two frames of the suite's robots is the 1 m of a stand.
constexpr double kOddlyFar = 2.0;  // [m]

/// A rotation is written with less than a turn. Rounded to four digits, a turn may be 6.284.
constexpr double kTurn = 2.0 * M_PI * 1.001;  // [rad]

/// The numbers of an attribute; urdfdom has refused what is none.
std::vector<double> numbers_of(const XMLElement& element, const char* attribute) {
  std::istringstream text(attribute_of(element, attribute));
  text.imbue(std::locale::classic());
  std::vector<double> numbers;
  for (double number; text >> number;) numbers.push_back(number);
  return numbers;
}

double number_of(const XMLElement& element, const char* attribute) {
  const std::vector<double> numbers = numbers_of(element, attribute);
  return numbers.empty() ? 0.0 : numbers.front();
}

Vec3 vector_of(const XMLElement& element, const char* attribute) {
  const std::vector<double> numbers = numbers_of(element, attribute);
  if (numbers.size() != 3) return Vec3::Zero();
  return {numbers[0], numbers[1], numbers[2]};
}

/// Zero where there is no origin.
double distance_of(const XMLElement& placed) {
  const XMLElement* origin = placed.FirstChildElement("origin");
  return origin ? vector_of(*origin, "xyz").norm() : 0.0;
}

/// From the centre of a shape to its farthest point [m]. None for a mesh, whose file is not opened.
std::optional<double> half_size_of(const XMLElement& placed) {
  const XMLElement* geometry = placed.FirstChildElement("geometry");
  const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
  if (!shape || std::string(shape->Name()) == "mesh") return std::nullopt;
  const double radius = number_of(*shape, "radius"), length = number_of(*shape, "length");
  return 0.5 * vector_of(*shape, "size").norm() + std::hypot(radius, 0.5 * length);
}

/// From the link's origin to the farthest point of its shapes [m]. None if a size is not known.
std::optional<double> reach_of_shapes(const XMLElement& link) {
  std::optional<double> reach;
  for (const char* kind : {"visual", "collision"}) {
    for (const XMLElement* shape = link.FirstChildElement(kind); shape;
         shape = shape->NextSiblingElement(kind)) {
      const std::optional<double> half_size = half_size_of(*shape);
      if (!half_size) return std::nullopt;
      reach = std::max(reach.value_or(0.0), distance_of(*shape) + *half_size);
    }
  }
  return reach;
}

Mat3 inertia_of(const XMLElement& element) {
  const auto moment = [&](const char* name) { return number_of(element, name); };
  Mat3 inertia;
  inertia << moment("ixx"), moment("ixy"), moment("ixz"),  //
      moment("ixy"), moment("iyy"), moment("iyz"),         //
      moment("ixz"), moment("iyz"), moment("izz");
  return inertia;
}

class Sizes {
 public:
  explicit Sizes(const UrdfFile& file) : file_(file) {}

  std::vector<std::string> odd() {
    const XMLElement& robot = file_.robot();
    for (const XMLElement* joint = robot.FirstChildElement("joint"); joint;
         joint = joint->NextSiblingElement("joint")) {
      check_joint(*joint);
    }
    for (const XMLElement* link = robot.FirstChildElement("link"); link;
         link = link->NextSiblingElement("link")) {
      check_link(*link);
    }
    return std::move(remarks_);
  }

 private:
  void remark(const XMLElement& element, const std::string& message) {
    remarks_.push_back(file_.at(element.GetLineNum(), message));
  }

  void check_joint(const XMLElement& joint) {
    const std::string place = label_of(joint) + ": ";
    check_origin(joint, place, "");
    if (const XMLElement* limit = joint.FirstChildElement("limit")) {
      check_limit(*limit, attribute_of(joint, "type"), place + "limit: ");
    }
    const XMLElement* parent = joint.FirstChildElement("parent");
    if (!parent) return;
    double& reach = reach_of_[attribute_of(*parent, "link")];
    reach = std::max(reach, distance_of(joint));
  }

  void check_link(const XMLElement& link) {
    const std::string place = label_of(link) + ": ";
    for (const char* kind : {"visual", "collision"}) {
      for (const XMLElement* shape = link.FirstChildElement(kind); shape;
           shape = shape->NextSiblingElement(kind)) {
        check_shape(*shape, place + kind + ": ");
      }
    }
    const XMLElement* inertial = link.FirstChildElement("inertial");
    if (!inertial) return;
    check_origin(*inertial, place + "inertial: ", "centre of mass ");
    // A link without shapes may be larger than its centre of mass and joints tell.
    double extent = reach_of_shapes(link).value_or(0.0);
    if (extent > 0.0) {
      extent = std::max({extent, distance_of(*inertial), reach_of_[attribute_of(link, "name")]});
    }
    check_inertial(*inertial, place, extent);
  }

  /// @param what lies there: "centre of mass "
  void check_origin(const XMLElement& placed, const std::string& place, const std::string& what) {
    const XMLElement* origin = placed.FirstChildElement("origin");
    if (!origin) return;
    const double distance = distance_of(placed);
    const std::string far = place + "origin: " + what + short_number(distance) + " m away: ";
    if (distance > kFarthest) {
      file_.fail(origin->GetLineNum(),
                 far + "expected at most " + short_number(kFarthest) + " m: in mm?");
    }
    if (distance > kOddlyFar) remark(*origin, far + "in mm or cm?");
    const double turn = vector_of(*origin, "rpy").cwiseAbs().maxCoeff();
    if (turn > kTurn) {
      file_.fail(origin->GetLineNum(), place + "origin: rpy: " + attribute_of(*origin, "rpy") +
                                           ": expected less than a turn [rad]: in degrees?");
    }
  }

  void check_shape(const XMLElement& shape, const std::string& place) {
    check_origin(shape, place, "");
    const double half_size = half_size_of(shape).value_or(0.0);
    if (half_size <= kFarthest) return;
    remark(shape,
           place + "geometry: reaches " + short_number(half_size) + " m from its centre: in mm?");
  }

  void check_limit(const XMLElement& limit, const std::string& type, const std::string& place) {
    const double lower = number_of(limit, "lower"), upper = number_of(limit, "upper");
    const double largest = std::max(std::abs(lower), std::abs(upper));
    const std::string range = short_number(lower) + " to " + short_number(upper);
    if (type == "revolute" && largest > kTurn) {
      remark(limit, place + range + " rad: more than a turn, expected radians: in degrees?");
    } else if (type == "prismatic" && largest > kOddlyFar) {
      remark(limit, place + range + " m: a long way: in mm?");
    } else if (largest > 0.0 && (type == "continuous" || type == "floating")) {
      remark(limit, place + range + ": not used, because a joint of type " + type +
                        " has no limits in a URDF" +
                        (type == "continuous" ? ": revolute?" : ": its stop is in the model file"));
    }
  }

  void check_inertial(const XMLElement& inertial, const std::string& place, double extent) {
    const XMLElement* mass = inertial.FirstChildElement("mass");
    const XMLElement* inertia = inertial.FirstChildElement("inertia");
    if (!mass || !inertia) return;  // urdfdom has said so
    const PlausibleBody body(number_of(*mass, "value"), inertia_of(*inertia), extent);
    if (const auto reason = body.impossible()) {
      file_.fail(inertia->GetLineNum(), place + *reason);
    }
    if (const auto oddity = body.odd()) remark(*inertia, place + *oddity);
  }

  const UrdfFile& file_;
  std::map<std::string, double> reach_of_;  ///< by link: of the farthest joint on it [m]
  std::vector<std::string> remarks_;
};

}  // namespace

std::vector<std::string> odd_sizes(const UrdfFile& file) {
  return Sizes(file).odd();
}

}  // namespace anthrob
