#include "protocol.h"

#include <algorithm>
#include <filesystem>
#include <iomanip>
#include <sstream>

namespace anthrob {

namespace {

constexpr const char* kWords[] = {"equilibria", "trajectories", "zero_gravity"};

Protocol::Kind read_kind(const ConfigNode& node) {
  const std::string text = node.as_text();
  for (int i = 0; i < 3; ++i) {
    if (text == kWords[i]) return static_cast<Protocol::Kind>(i);
  }
  node.fail_expected("equilibria, trajectories or zero_gravity");
}

SettleOptions read_settle(const ConfigNode& node) {
  SettleOptions settle;
  settle.actuator_velocity = node.number("actuator_velocity", Bounds::positive(), "rad/s");
  settle.joint_velocity = node.number("joint_velocity", Bounds::positive(), "rad/s");
  settle.window = node.number("window", Bounds::positive(), "s");
  settle.timeout = node.number("timeout", Bounds::positive(), "s");
  return settle;
}

std::vector<Protocol::Target> read_targets(const std::string& file,
                                           const std::shared_ptr<const RobotModel>& model) {
  const PostureSequence sequence = PostureSequence::load(file, *model);
  const auto references = sequence.references(model);
  std::vector<Protocol::Target> targets;
  for (std::size_t i = 0; i < sequence.steps.size(); ++i)
    targets.push_back({sequence.steps[i].name, sequence.steps[i].q, references[i],
                       !sequence.steps[i].reference.empty()});
  return targets;
}

/// The references of all postures, rounded so that another build of the program can continue.
std::string references_text(const Protocol& protocol) {
  std::ostringstream text;
  text << std::setprecision(4) << std::fixed;
  std::vector<Protocol::Target> all = protocol.targets;
  all.push_back(protocol.rest);
  for (const Protocol::Target& target : all) {
    for (const double reference : target.reference) text << reference << " ";
  }
  return text.str();
}

const Protocol::Target& pick(const std::vector<Protocol::Target>& all, const std::string& postures,
                             const ConfigNode& name) {
  const std::string text = name.as_text();
  const auto it = std::find_if(all.begin(), all.end(),
                               [&](const Protocol::Target& t) { return t.name == text; });
  if (it == all.end()) {
    name.fail("'" + text + "': expected the name of a posture in " + postures);
  }
  return *it;
}

}  // namespace

const char* word(Protocol::Kind kind) {
  return kWords[static_cast<int>(kind)];
}

Protocol Protocol::load(const std::string& file, const std::shared_ptr<const RobotModel>& model) {
  const ConfigNode node = ConfigNode::load(file);
  Protocol protocol;
  protocol.kind = read_kind(node.at("protocol"));
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  const std::string postures = (folder / node.text("postures")).string();
  const std::vector<Target> all = read_targets(postures, model);
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (all[k].name == all[i].name)
        throw BadInput(postures + ": posture '" + all[i].name +
                       "' is listed twice; expected each name once");
    }
  }
  protocol.rest = pick(all, postures, node.at("rest"));
  if (node.has("visit")) {
    for (const ConfigNode& name : node.at("visit").items()) {
      const Target& target = pick(all, postures, name);
      const auto again = [&](const Target& other) { return other.name == target.name; };
      if (std::any_of(protocol.targets.begin(), protocol.targets.end(), again))
        name.fail("is listed twice; to visit all postures several times, set 'repeats'");
      if (target.name == protocol.rest.name && protocol.kind == Kind::kTrajectories)
        name.fail("is the rest posture; expected another one, to which a trajectory can lead");
      protocol.targets.push_back(target);
    }
  } else {
    for (const Target& target : all) {
      // There is no way from the rest posture to itself.
      const bool itself = target.name == protocol.rest.name;
      if (!itself || protocol.kind != Kind::kTrajectories) protocol.targets.push_back(target);
    }
  }
  if (protocol.targets.empty()) node.fail("no posture to visit");
  if (node.has("repeats")) protocol.repeats = node.at("repeats").as_integer(1, 1000);
  protocol.settle = read_settle(node.at("settle"));
  protocol.hold = node.number("hold", Bounds::positive(), "s");
  protocol.average = node.number("average", Bounds::between(0.0, protocol.hold), "s");
  const ConfigNode drift = node.at("drift");
  protocol.drift_limit = drift.number("limit", Bounds::positive(), "rad");
  protocol.redo = drift.at("redo").as_integer(0, 100);
  if (protocol.kind == Kind::kZeroGravity) {
    protocol.by_hand = node.has("by_hand") && node.at("by_hand").as_bool();
    protocol.go_duration =
        node.number_or("go_duration", protocol.go_duration, Bounds::positive(), "s");
  }
  // The controller goes to joint positions, so it cannot use references.
  if (protocol.kind == Kind::kZeroGravity && !protocol.by_hand) {
    std::vector<Target> visited = protocol.targets;
    visited.push_back(protocol.rest);
    for (const Target& target : visited) {
      if (!target.by_references) continue;
      throw BadInput(postures + ": posture '" + target.name +
                     "': has references; zero gravity expects joints instead");
    }
  }
  node.refuse_unknown_keys();
  protocol.text = node.to_yaml() + "\n" + ConfigNode::load(postures).to_yaml() + "\n" +
                  references_text(protocol);
  return protocol;
}

}  // namespace anthrob
