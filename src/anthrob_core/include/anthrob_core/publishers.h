#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace anthrob {

/// Which node publishes what of a topic. A node that takes over from another one, which has ended,
/// is no conflict; two that alternate are.
class Publishers {
 public:
  /// @param names of muscles or joints in a message   @param node that sent it; empty: not known
  void add(const std::vector<std::string>& names, const std::string& node);

  /// "two nodes publish elbow: /encoders and /joint_state_publisher"; none if nobody does.
  const std::optional<std::string>& conflict() const { return conflict_; }

 private:
  struct Past {
    std::string last;
    std::set<std::string> before;
  };
  std::map<std::string, Past> past_;
  std::optional<std::string> conflict_;
};

}  // namespace anthrob
