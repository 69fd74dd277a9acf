#include "registration_rules.h"

namespace anthrob {

bool RegistrationRules::is_lost(Look look, double now) const {
  switch (look) {
    case Look::kRegistered:
      return false;
    case Look::kIncomplete:
    case Look::kGone:
      return true;
    case Look::kSilent:
      return lost_ || now - answered_ >= patience_;
  }
  return true;
}

std::optional<Turn> RegistrationRules::see(Look look, double now) {
  if (look == Look::kRegistered || look == Look::kIncomplete) answered_ = now;
  const bool was_lost = lost_;
  lost_ = is_lost(look, now);
  if (lost_ == was_lost) return std::nullopt;
  return lost_ ? Turn::kLost : Turn::kRegained;
}

}  // namespace anthrob
