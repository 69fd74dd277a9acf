#pragma once

#include <string>
#include <vector>

namespace anthrob {

/// What may stand in an element of a URDF.
struct UrdfElement {
  std::string name;
  std::vector<std::string> attributes;
  std::vector<std::string> once;          ///< elements in it, each at most once
  std::vector<std::string> several = {};  ///< elements in it, any number of them
  bool others = false;      ///< elements of other programs stand in it and are left alone
  bool is_foreign = false;  ///< known, but of another program: not looked into

  bool has_attribute(const std::string& attribute) const;
  bool has_element(const std::string& element) const;
  bool has_once(const std::string& element) const;
  std::vector<std::string> elements() const;
};

/// Null if no element has this name.
const UrdfElement* find_urdf_element(const std::string& name);

/// Names of the elements in which one of this name may stand: "link or joint".
std::string urdf_parents_of(const std::string& name);

/// Elements that xacro replaced before they had to be called xacro:...
bool is_old_xacro(const std::string& name);

/// "revolute", ...
const std::vector<std::string>& urdf_joint_types();

/// "a, b or c"
std::string alternatives(const std::vector<std::string>& words);

}  // namespace anthrob
