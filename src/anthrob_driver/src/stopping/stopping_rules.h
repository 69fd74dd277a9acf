#pragma once

#include <vector>

#include "anthrob_driver/findings.h"
#include "link/ecu_link.h"

namespace anthrob {
namespace driver {

// Which conditions stop the motors without a user, and how: kStoppingRules, in stopping_rules.cpp.

/// Who notices that a rule's condition holds.
enum class NoticedBy {
  kFrame,        ///< RobotDriver, by a frame that only another host sends, as soon as it comes
  kBusWatch,     ///< BusWatch: interface, error frames, full queue, missing echoes
  kAllEcus,      ///< bus_silent(): all ECUs together
  kEcu,          ///< the rule itself (StoppingRule::holds), of each ECU in turn
  kSupervisor,   ///< ecu::Supervisor: commands stay away
  kMuscleWatch,  ///< MuscleWatch: tendon, encoder, force sensor or winding of a muscle
  kHome,         ///< Home or Zeros, while `home` runs
  kNode,         ///< the ROS node around the driver, which nobody may reach any more
};

/// What then happens to the motors.
enum class Reaction {
  kDisable,             ///< unless they are: all are disabled, and the stop is recorded
  kDisableThenExplain,  ///< the same, but recorded once the ECU has named its reason: an ECU
                        ///< reports that it stopped some frames before it reports why
  kEmergencyStop,  ///< an emergency stop that others hold, or that the node asks for, is passed
                   ///< on to all, and latched
  kEndHome,        ///< as kDisable; tendons that `home` lost have no zero
};

/// What then happens to the ECU that it concerns; all others are only disabled.
enum class Concerned {
  kNone,         ///< no ECU is to blame
  kDisabled,     ///< it may be enabled again at once
  kFault,        ///< if motors were not disabled: it counts as in FAULT until clear_faults
  kAlwaysFault,  ///< the same while nothing runs, too: the user must know before enabling
};

/// Who adds it to the findings.
enum class Noted {
  kByRule,      ///< the rule
  kBySource,    ///< whoever noticed it has done so
  kWithReason,  ///< the stop, once its reason is known
};

/// What rules about an ECU look at besides the ECU.
struct Situation {
  bool enabled = false, disabled = false;  ///< neither: enabling
  bool stop_latched = false;               ///< an emergency stop of this driver holds
  bool clearing = false;                   ///< the ECUs are clearing their faults
  bool bus_silent = false;
  double now = 0.0;          ///< [s]
  double since_clear = 0.0;  ///< [s] since clear_faults was called last
};

struct StoppingRule {
  Finding finding;
  NoticedBy noticed_by;
  Reaction reaction;
  Concerned concerned;
  Noted noted;
  /// Only of NoticedBy::kEcu: whether the condition holds. What an ECU reports only once is taken.
  bool (*holds)(EcuLink& link, const Situation& situation);
};
constexpr int kStoppingRuleCount = 22;

/// In the order in which a cycle looks at them; frames come in between. Every finding that stops
/// (FindingInfo::stops) has a rule, and no other has.
extern const StoppingRule kStoppingRules[kStoppingRuleCount];
/// @throws std::logic_error if there is none
const StoppingRule& stopping_rule(Finding finding, NoticedBy noticed_by);

/// Of a bus on which nobody answers, no single ECU is to blame.
bool bus_silent(const std::vector<EcuLink>& links);
/// Whether this ECU was heard and measures no more, or never began to.
bool is_lost(const EcuLink& link, double now);

constexpr double kFirstAnswer = 1.0;  ///< [s] for an ECU to be heard, and then to measure
constexpr double kClearGrace = 0.15;  ///< [s] until ECUs have cleared their latches

}  // namespace driver
}  // namespace anthrob
