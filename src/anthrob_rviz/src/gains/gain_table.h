#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gains/gain.h"

namespace anthrob {

/// The gains that a robot holds, and what its user changed, to be undone. What others change is
/// shown, too, and left alone.
class GainTable {
 public:
  enum class Why { kRead, kChange, kUndo };  ///< the robot was asked

  /// @param held all gains that are in force now: the answer to every request, also to a refused
  /// one
  void hear(const std::vector<Gain>& held, Why why);
  void clear();

  /// In the robot's order, each once.
  std::vector<std::string> muscles() const;
  std::vector<std::string> names() const;

  struct Entry {
    double value;
    bool same;  ///< for all muscles that were asked for
  };
  /// @param muscle empty: all, with the value of the first one   @return none if nobody has it
  std::optional<Entry> entry(const std::string& muscle, const std::string& name) const;

  bool can_undo() const { return !changes_.empty(); }
  /// The request that takes the last change back, if can_undo().
  std::vector<Gain> undo() const { return changes_.back(); }

 private:
  std::vector<Gain> replaced_by(const std::vector<Gain>& held) const;

  std::vector<Gain> held_;
  std::vector<std::vector<Gain>> changes_;  ///< what each one replaced, the last one last
};

}  // namespace anthrob
