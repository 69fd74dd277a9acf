#pragma once

#include <functional>
#include <string>

namespace anthrob {
namespace discovery {

/// Who is told what discovery does, and may stop it.
struct Observer {
  /// Called with the name of each stage as it begins; returns false to stop.
  std::function<bool(const std::string&)> progress;
  std::function<void(const std::string&)> comment;    ///< a line on what was found so far
  std::function<void(const std::string&)> candidate;  ///< what would be named now

  /// Reports that a stage begins. @throws Interrupted
  void stage(const std::string& what) const;
  /// Reports a line on what was found so far.
  void say(const std::string& line) const;
  /// Reports the effects that would be named now.
  void favour(const std::string& names) const;
};

}  // namespace discovery
}  // namespace anthrob
