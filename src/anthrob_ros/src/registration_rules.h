#pragma once

#include <optional>

namespace anthrob {

/// What one look at the ROS master showed.
enum class Look {
  kRegistered,  ///< it knows all that this node offers
  kIncomplete,  ///< it answers, and does not
  kGone,        ///< nobody listens where it was
  kSilent,      ///< no answer, for whatever other reason
};

enum class Turn { kLost, kRegained };

/// Decides from one look after the other whether this node is registered. Of a master that is gone,
/// or answers without us, one look is enough. A master that only keeps silent may be slow on a busy
/// machine, and has kPatience.
class RegistrationRules {
 public:
  static constexpr double kPatience = 10.0;  ///< [s] with a look each second

  /// Begins registered. @param now [s] of a clock that never jumps
  explicit RegistrationRules(double now, double patience = kPatience)
      : patience_(patience), answered_(now) {}

  /// @return what has changed by this look
  std::optional<Turn> see(Look look, double now);

 private:
  bool is_lost(Look look, double now) const;

  double patience_;  ///< [s]
  bool lost_ = false;
  double answered_;  ///< [s] when the master answered last
};

}  // namespace anthrob
