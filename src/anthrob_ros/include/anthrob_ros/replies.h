#pragma once

namespace anthrob {

/// What happened, in the words of simulator and driver alike, for those who call by hand.
namespace done {
constexpr char kEnabled[] = "enabled: motors follow commands";
constexpr char kDisabled[] = "disabled; call enable to move again";
constexpr char kStopped[] = "stopped; call clear_faults, then enable, to move again";
constexpr char kCleared[] = "cleared; call enable to move again";
constexpr char kHomed[] = "zero positions are known";
constexpr char kGains[] = "held_value: the gains in force";
}  // namespace done

/// Completes a reply that reports a success and says nothing.
template <typename Response>
void say_done(Response& response, const char* what) {
  if (response.success && response.message.empty()) response.message = what;
}

}  // namespace anthrob
