#include "skeleton/urdf_schema.h"

#include <algorithm>

namespace anthrob {

namespace {

/// As http://wiki.ros.org/urdf/XML has it, for what urdfdom 3 reads. An element means the same
/// wherever it stands.
const std::vector<UrdfElement>& known_elements() {
  static const std::vector<UrdfElement> known = {
      {"robot", {"name", "version"}, {}, {"link", "joint", "material"}, true},
      {"link", {"name"}, {"inertial"}, {"visual", "collision"}},
      {"joint",
       {"name", "type"},
       {"parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "safety_controller",
        "calibration"}},
      {"inertial", {}, {"origin", "mass", "inertia"}},
      {"visual", {"name"}, {"origin", "geometry", "material"}},
      {"collision", {"name"}, {"origin", "geometry"}},
      {"geometry", {}, {"box", "sphere", "cylinder", "mesh"}},
      {"material", {"name"}, {"color", "texture"}},
      {"origin", {"xyz", "rpy"}, {}},
      {"mass", {"value"}, {}},
      {"inertia", {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}, {}},
      {"box", {"size"}, {}},
      {"sphere", {"radius"}, {}},
      {"cylinder", {"radius", "length"}, {}},
      {"mesh", {"filename", "scale"}, {}},
      {"color", {"rgba"}, {}},
      {"texture", {"filename"}, {}},
      {"parent", {"link"}, {}},
      {"child", {"link"}, {}},
      {"axis", {"xyz"}, {}},
      {"limit", {"lower", "upper", "effort", "velocity"}, {}},
      {"dynamics", {"damping", "friction"}, {}},
      {"mimic", {"joint", "multiplier", "offset"}, {}},
      {"safety_controller", {}, {}, {}, true, true},
      {"calibration", {}, {}, {}, true, true},
  };
  return known;
}

bool contains(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

bool UrdfElement::has_attribute(const std::string& attribute) const {
  return contains(attributes, attribute);
}

bool UrdfElement::has_once(const std::string& element) const {
  return contains(once, element);
}

bool UrdfElement::has_element(const std::string& element) const {
  return has_once(element) || contains(several, element);
}

std::vector<std::string> UrdfElement::elements() const {
  std::vector<std::string> all = once;
  all.insert(all.end(), several.begin(), several.end());
  return all;
}

const UrdfElement* find_urdf_element(const std::string& name) {
  for (const UrdfElement& element : known_elements()) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

std::string urdf_parents_of(const std::string& name) {
  std::vector<std::string> parents;
  for (const UrdfElement& element : known_elements()) {
    if (element.has_element(name)) parents.push_back("<" + element.name + ">");
  }
  return alternatives(parents);
}

bool is_old_xacro(const std::string& name) {
  static const std::vector<std::string> names = {"arg",   "if",       "include", "insert_block",
                                                 "macro", "property", "unless"};
  return contains(names, name);
}

const std::vector<std::string>& urdf_joint_types() {
  static const std::vector<std::string> types = {"revolute", "continuous", "prismatic",
                                                 "fixed",    "floating",   "planar"};
  return types;
}

std::string alternatives(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace anthrob
