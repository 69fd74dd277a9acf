#include "skeleton/urdf_spelling.h"

#include <map>

#include "anthrob_core/nearest_name.h"
#include "skeleton/urdf_schema.h"

namespace anthrob {

namespace {

using tinyxml2::XMLAttribute;
using tinyxml2::XMLElement;
using tinyxml2::XMLNode;

constexpr const char* kRunXacro = ": expected a URDF; run xacro first (xacro FILE > robot.urdf)";

bool begins_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

bool is_of_xacro(const std::string& name) {
  return begins_with(name, "xacro:");
}

bool is_expression_of_xacro(const std::string& value) {
  return value.find("${") != std::string::npos || value.find("$(") != std::string::npos;
}

/// Declarations of XML itself.
bool is_of_xml(const std::string& attribute) {
  return attribute == "xmlns" || begins_with(attribute, "xmlns:") ||
         begins_with(attribute, "xsi:") || begins_with(attribute, "xml:");
}

/// For a type that no URDF has: what other descriptions of robots call it, or the nearest name.
std::string expected_joint_type(const std::string& type) {
  constexpr const char* kBall =
      "floating, which stands for a ball joint; then the model file has type: ball and its center";
  static const std::map<std::string, std::string> others = {
      {"ball", kBall},         {"ball_joint", kBall},          {"spherical", kBall},
      {"socket", kBall},       {"hinge", "revolute"},          {"rotational", "revolute"},
      {"rotary", "revolute"},  {"slide", "prismatic"},         {"slider", "prismatic"},
      {"linear", "prismatic"}, {"translational", "prismatic"}, {"weld", "fixed"},
      {"rigid", "fixed"}};
  const auto found = others.find(type);
  if (found != others.end()) return found->second;
  const auto nearest = nearest_name(type, urdf_joint_types());
  return nearest ? *nearest : alternatives(urdf_joint_types());
}

class Spelling {
 public:
  explicit Spelling(const UrdfFile& file) : file_(file) {}

  /// @param place "joint elbow: origin: ", of the element itself
  void check(const XMLElement& element, const UrdfElement& known, const std::string& place) const {
    check_attributes(element, known, place);
    if (known.name == "joint") check_joint_type(element, place);
    for (const XMLNode* node = element.FirstChild(); node; node = node->NextSibling()) {
      if (node->ToComment()) continue;
      if (const XMLElement* inner = node->ToElement()) {
        check_inner(*inner, known, place);
      } else {
        refuse_text(*node, known, place);
      }
    }
    if (known.name == "geometry") refuse_second_shape(element, place);
  }

 private:
  void check_attributes(const XMLElement& element, const UrdfElement& known,
                        const std::string& place) const {
    for (const XMLAttribute* a = element.FirstAttribute(); a; a = a->Next()) {
      const std::string name = a->Name(), value = a->Value();
      if (is_of_xml(name)) continue;
      const auto fail = [&](const std::string& message) {
        file_.fail(a->GetLineNum(), place + in_one_line(name) + message);
      };
      if (is_of_xacro(name)) fail(kRunXacro);
      if (!known.has_attribute(name)) fail(unknown_attribute(name, known));
      if (is_expression_of_xacro(value)) fail(": " + in_one_line(value) + kRunXacro);
      if (value.find('\n') != std::string::npos) {
        fail(": a line end in the attribute: expected all of it on one line");
      }
      if (value.find('\t') != std::string::npos) {
        fail(": a tab in the attribute: expected blanks");
      }
    }
  }

  static std::string unknown_attribute(const std::string& name, const UrdfElement& known) {
    const std::string unknown = ": unknown attribute; expected ";
    if (known.has_element(name)) return unknown + "it as an element <" + name + ">";
    if (known.name == "origin" && name.find("quat") != std::string::npos) {
      return unknown + "the rotation as rpy=\"roll pitch yaw\" [rad]";
    }
    if (known.attributes.empty()) return unknown + "none in <" + known.name + ">";
    const auto nearest = nearest_name(name, known.attributes);
    return unknown + (nearest ? *nearest : alternatives(known.attributes));
  }

  void check_joint_type(const XMLElement& joint, const std::string& place) const {
    const XMLAttribute* type = joint.FindAttribute("type");
    if (!type) return;  // urdfdom says so
    for (const std::string& known : urdf_joint_types()) {
      if (known == type->Value()) return;
    }
    file_.fail(type->GetLineNum(), place + "type: " + in_one_line(type->Value()) + ": expected " +
                                       expected_joint_type(type->Value()));
  }

  void check_inner(const XMLElement& inner, const UrdfElement& known,
                   const std::string& place) const {
    const std::string name = inner.Name();
    if (is_of_xacro(name))
      file_.fail(inner.GetLineNum(), place_in(place, known) + name + kRunXacro);
    const UrdfElement* own = find_urdf_element(name);
    if (!known.has_element(name)) {
      if (known.others && !is_meant_for_us(name, known)) return;
      file_.fail(inner.GetLineNum(),
                 place_in(place, known) + in_one_line(name) + unknown_element(name, known));
    }
    if (own->is_foreign) return;
    if (known.has_once(name)) refuse_second(inner, place);
    check(inner, *own, place_in(place, known) + label_of(inner) + ": ");
  }

  /// What stands directly in <robot> needs no "robot: " before it.
  static std::string place_in(const std::string& place, const UrdfElement& known) {
    return known.name == "robot" ? "" : place;
  }

  /// Whether an element among those of other programs was meant for this one.
  static bool is_meant_for_us(const std::string& name, const UrdfElement& known) {
    return find_urdf_element(name) || is_old_xacro(name) || nearest_name(name, known.elements());
  }

  static std::string unknown_element(const std::string& name, const UrdfElement& known) {
    if (is_old_xacro(name)) return kRunXacro;
    const std::string unknown = ": unknown element; expected ";
    if (known.has_attribute(name)) return unknown + "it as an attribute " + name + "=\"...\"";
    if (find_urdf_element(name)) {
      const std::string parents = urdf_parents_of(name);
      const std::string elsewhere = parents.empty() ? "it around all" : "it in " + parents;
      return ": not an element of <" + known.name + ">; expected " + elsewhere;
    }
    const std::vector<std::string> elements = known.elements();
    if (elements.empty()) return unknown + "none in <" + known.name + ">";
    const auto nearest = nearest_name(name, elements);
    return unknown + (nearest ? *nearest : alternatives(elements));
  }

  void refuse_second(const XMLElement& element, const std::string& place) const {
    const XMLElement* before = element.PreviousSiblingElement(element.Name());
    if (!before) return;
    file_.fail(element.GetLineNum(),
               place + element.Name() + ": appears twice; expected it once, the first is in line " +
                   std::to_string(before->GetLineNum()));
  }

  void refuse_second_shape(const XMLElement& geometry, const std::string& place) const {
    const XMLElement* first = geometry.FirstChildElement();
    const XMLElement* second = first ? first->NextSiblingElement() : nullptr;
    if (!second) return;
    file_.fail(second->GetLineNum(), place + second->Name() + ": a second shape beside " +
                                         first->Name() +
                                         "; expected one, and another <visual> or <collision>");
  }

  void refuse_text(const XMLNode& node, const UrdfElement& known, const std::string& place) const {
    const std::string text = "text '" + in_one_line(node.Value()) + "': expected ";
    if (known.attributes.empty() || !known.elements().empty()) {
      file_.fail(node.GetLineNum(), place + text + "elements only; is a comment not closed?");
    }
    file_.fail(node.GetLineNum(),
               place + text + "attributes: " + known.attributes.front() + "=\"...\"");
  }

  const UrdfFile& file_;
};

}  // namespace

void refuse_what_is_not_read(const UrdfFile& file) {
  const UrdfElement& robot = *find_urdf_element("robot");
  Spelling(file).check(file.robot(), robot, "robot: ");
}

}  // namespace anthrob
