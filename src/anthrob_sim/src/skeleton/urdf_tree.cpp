#include "skeleton/urdf_tree.h"

#include <algorithm>

#include "anthrob_core/nearest_name.h"
#include "anthrob_core/text.h"

namespace anthrob {

namespace {

using tinyxml2::XMLElement;

/// "a, b and c"; of many only the first.
std::string all_of(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kShown; ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  if (names.size() > kShown) text += " and " + std::to_string(names.size() - kShown) + " more";
  return text;
}

/// More than any robot has, and less than urdfdom's and our own recursion need to end the stack.
constexpr std::size_t kMostLinks = 10000;
constexpr int kLongestChain = 1000;

std::string required_name(const UrdfFile& file, const XMLElement& element) {
  const std::string name = attribute_of(element, "name");
  if (name.empty()) {
    file.fail(element.GetLineNum(), std::string(element.Name()) + ": expected name=\"...\"");
  }
  return name;
}

}  // namespace

UrdfTree::UrdfTree(const UrdfFile& file) : file_(file) {
  const XMLElement& robot = file.robot();
  for (const XMLElement* link = robot.FirstChildElement("link"); link;
       link = link->NextSiblingElement("link")) {
    add_link(*link);
  }
  for (const XMLElement* joint = robot.FirstChildElement("joint"); joint;
       joint = joint->NextSiblingElement("joint")) {
    add_joint(*joint);
  }
}

void UrdfTree::require_tree() const {
  refuse_joints_of_one_link();
  refuse_two_parents();
  refuse_detached_loops();
  refuse_several_roots();
  refuse_long_chains();
}

void UrdfTree::add_link(const XMLElement& element) {
  if (links_.size() == kMostLinks) {
    file_.fail(element.GetLineNum(),
               "more than " + std::to_string(kMostLinks) + " links; expected a robot");
  }
  const std::string name = required_name(file_, element);
  const auto [known, is_new] = link_of_.emplace(name, static_cast<int>(links_.size()));
  if (!is_new) {
    file_.fail(element.GetLineNum(), "link " + name +
                                         ": appears twice; expected each name once, the first is "
                                         "in line " +
                                         std::to_string(links_[known->second].line));
  }
  links_.push_back({name, element.GetLineNum(), {}, {}});
}

void UrdfTree::add_joint(const XMLElement& element) {
  const std::string name = required_name(file_, element);
  const int index = static_cast<int>(joints_.size());
  const auto [known, is_new] = joint_of_.emplace(name, index);
  if (!is_new) {
    file_.fail(element.GetLineNum(), "joint " + name +
                                         ": appears twice; expected each name once, the first is "
                                         "in line " +
                                         std::to_string(joints_[known->second].line));
  }
  const int parent = end_of(element, "parent"), child = end_of(element, "child");
  joints_.push_back({name, element.GetLineNum(), parent, child});
  links_[parent].below.push_back(index);
  links_[child].above.push_back(index);
}

int UrdfTree::end_of(const XMLElement& joint, const char* end) const {
  const std::string place = label_of(joint) + ": " + end + ": ";
  const XMLElement* element = joint.FirstChildElement(end);
  const std::string name = element ? attribute_of(*element, "link") : "";
  if (name.empty()) {
    const int line = element ? element->GetLineNum() : joint.GetLineNum();
    file_.fail(line, place + "missing; expected <" + end + " link=\"...\"/>");
  }
  const auto found = link_of_.find(name);
  if (found != link_of_.end()) return found->second;
  std::vector<std::string> names;
  for (const Link& link : links_) names.push_back(link.name);
  const auto nearest = nearest_name(name, names);
  file_.fail(element->GetLineNum(),
             place + name + ": expected the name of a link" + (nearest ? ", as " + *nearest : ""));
}

void UrdfTree::refuse_joints_of_one_link() const {
  for (const Joint& joint : joints_) {
    if (joint.parent != joint.child) continue;
    file_.fail(joint.line, "joint " + joint.name + ": parent and child are both " +
                               links_[joint.child].name + "; expected two links");
  }
}

void UrdfTree::refuse_two_parents() const {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    if (link.above.size() < 2) continue;
    refuse_loop_through(static_cast<int>(i));
    std::vector<std::string> names;
    for (const int joint : link.above) names.push_back(joints_[joint].name);
    file_.fail(joints_[link.above[1]].line,
               "link " + link.name + ": child of joints " + all_of(names) +
                   "; expected one parent: a closed chain is not simulated; is a joint left over, "
                   "or meant for another link?");
  }
}

/// A link with two parents may hang on a link below it: that is another mistake, and said
/// otherwise.
void UrdfTree::refuse_loop_through(int link) const {
  std::vector<int> came_by(links_.size(), -1), reached = {link};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const int joint : links_[reached[next]].below) {
      const int child = joints_[joint].child;
      if (child == link) {
        std::vector<int> loop = {joint};
        for (int at = reached[next]; at != link; at = joints_[loop.back()].parent) {
          loop.push_back(came_by[at]);
        }
        std::reverse(loop.begin(), loop.end());
        file_.fail(joints_[joint].line, "joint " + joints_[joint].name + ": closes " +
                                            loop_text(loop) +
                                            "; expected a tree: are parent and child swapped?");
      }
      if (came_by[child] >= 0) continue;
      came_by[child] = joint;
      reached.push_back(child);
    }
  }
}

/// "a loop of links upper_arm and forearm (joints elbow and loop)"
std::string UrdfTree::loop_text(const std::vector<int>& joints) const {
  std::vector<std::string> names, links;
  for (const int joint : joints) {
    names.push_back(joints_[joint].name);
    links.push_back(links_[joints_[joint].parent].name);
  }
  return "a loop of links " + all_of(links) + " (joints " + all_of(names) + ")";
}

/// Where every link has one parent at most, a loop hangs on nothing else: the way up from each of
/// its links comes back to it.
void UrdfTree::refuse_detached_loops() const {
  constexpr int kNever = -1;
  std::vector<int> walk_of(links_.size(), kNever);
  for (std::size_t start = 0; start < links_.size(); ++start) {
    int at = static_cast<int>(start);
    while (walk_of[at] == kNever && !links_[at].above.empty()) {
      walk_of[at] = static_cast<int>(start);
      at = joints_[links_[at].above.front()].parent;
    }
    if (walk_of[at] != static_cast<int>(start)) continue;
    std::vector<int> loop;
    int link = at;
    do {
      loop.push_back(links_[link].above.front());
      link = joints_[loop.back()].parent;
    } while (link != at);
    std::reverse(loop.begin(), loop.end());
    file_.fail(joints_[loop.back()].line,
               "joint " + joints_[loop.back()].name + ": closes " + loop_text(loop) +
                   ", which hangs on no other link; expected a tree: is a parent misspelt?");
  }
}

void UrdfTree::refuse_several_roots() const {
  std::vector<const Link*> roots;
  for (const Link& link : links_) {
    if (link.above.empty()) roots.push_back(&link);
  }
  if (roots.size() < 2) return;
  std::vector<std::string> names;
  for (const Link* root : roots) names.push_back(root->name);
  file_.fail(roots[1]->line, "links " + all_of(names) +
                                 ": children of no joint; expected one root: is a joint missing?");
}

/// Of a tree.
void UrdfTree::refuse_long_chains() const {
  std::vector<int> depth(links_.size(), 0), reached;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].above.empty()) reached.push_back(static_cast<int>(i));
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const int joint : links_[reached[next]].below) {
      const int child = joints_[joint].child;
      depth[child] = depth[reached[next]] + 1;
      reached.push_back(child);
      if (depth[child] <= kLongestChain) continue;
      file_.fail(joints_[joint].line,
                 "joint " + joints_[joint].name + ": the " + std::to_string(depth[child]) +
                     "th in a chain; expected at most " + std::to_string(kLongestChain));
    }
  }
}

}  // namespace anthrob
