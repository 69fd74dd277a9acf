#include "stopping/stopping_rules.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace anthrob {
namespace driver {

namespace {

bool restarted(EcuLink& link, const Situation&) {
  return link.take_restart();
}

bool speaks_another_version(EcuLink& link, const Situation&) {
  return link.take_wrong_version();
}

bool answers_no_more(EcuLink& link, const Situation& s) {
  return is_lost(link, s.now) && !s.bus_silent;
}

/// What the others are about is old of one that is lost.
bool reports(const EcuLink& link, const Situation& s) {
  return link.heard() && !is_lost(link, s.now);
}

bool is_in_fault(EcuLink& link, const Situation& s) {
  // A fault that is being cleared is not reported again.
  return reports(link, s) && link.state() == ecu::State::kFault && !(s.disabled && s.clearing);
}

bool holds_a_stop(EcuLink& link, const Situation& s) {
  return reports(link, s) && link.stop_latched() && !s.stop_latched && s.since_clear > kClearGrace;
}

bool stopped_by_itself(EcuLink& link, const Situation& s) {
  return reports(link, s) && s.enabled && link.state() != ecu::State::kEnabled;
}

}  // namespace

// clang-format off
const StoppingRule kStoppingRules[kStoppingRuleCount] = {
    // finding                   noticed by               the motors                     the ECU concerned        added to findings   condition
    {Finding::kStopLatched,      NoticedBy::kFrame,       Reaction::kEmergencyStop,      Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kSecondHost,       NoticedBy::kFrame,       Reaction::kDisable,            Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kInterfaceDown,    NoticedBy::kBusWatch,    Reaction::kDisable,            Concerned::kNone,        Noted::kBySource,   nullptr},
    {Finding::kBusOff,           NoticedBy::kBusWatch,    Reaction::kDisable,            Concerned::kNone,        Noted::kBySource,   nullptr},
    {Finding::kErrorPassive,     NoticedBy::kBusWatch,    Reaction::kDisable,            Concerned::kNone,        Noted::kBySource,   nullptr},
    {Finding::kNoAcknowledge,    NoticedBy::kBusWatch,    Reaction::kDisable,            Concerned::kNone,        Noted::kBySource,   nullptr},
    {Finding::kQueueFull,        NoticedBy::kBusWatch,    Reaction::kDisable,            Concerned::kNone,        Noted::kBySource,   nullptr},
    {Finding::kBusSilent,        NoticedBy::kAllEcus,     Reaction::kDisable,            Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kEcuRestarted,     NoticedBy::kEcu,         Reaction::kDisable,            Concerned::kAlwaysFault, Noted::kBySource,   restarted},
    {Finding::kWrongVersion,     NoticedBy::kEcu,         Reaction::kDisable,            Concerned::kFault,       Noted::kBySource,   speaks_another_version},
    {Finding::kEcuLost,          NoticedBy::kEcu,         Reaction::kDisable,            Concerned::kFault,       Noted::kByRule,     answers_no_more},
    {Finding::kEcuFault,         NoticedBy::kEcu,         Reaction::kDisableThenExplain, Concerned::kFault,       Noted::kByRule,     is_in_fault},
    {Finding::kStopLatched,      NoticedBy::kEcu,         Reaction::kEmergencyStop,      Concerned::kDisabled,    Noted::kByRule,     holds_a_stop},
    {Finding::kEcuStopped,       NoticedBy::kEcu,         Reaction::kDisableThenExplain, Concerned::kDisabled,    Noted::kWithReason, stopped_by_itself},
    {Finding::kCommandTimeout,   NoticedBy::kSupervisor,  Reaction::kDisable,            Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kTendonSlack,      NoticedBy::kMuscleWatch, Reaction::kDisable,            Concerned::kFault,       Noted::kByRule,     nullptr},
    {Finding::kEncoderDead,      NoticedBy::kMuscleWatch, Reaction::kDisable,            Concerned::kFault,       Noted::kByRule,     nullptr},
    {Finding::kForceImplausible, NoticedBy::kMuscleWatch, Reaction::kDisable,            Concerned::kFault,       Noted::kByRule,     nullptr},
    {Finding::kMotorHot,         NoticedBy::kMuscleWatch, Reaction::kDisable,            Concerned::kFault,       Noted::kByRule,     nullptr},
    {Finding::kHomeFailed,       NoticedBy::kHome,        Reaction::kEndHome,            Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kUnregistered,     NoticedBy::kNode,        Reaction::kEmergencyStop,      Concerned::kNone,        Noted::kByRule,     nullptr},
    {Finding::kNoDescriptors,    NoticedBy::kNode,        Reaction::kEmergencyStop,      Concerned::kNone,        Noted::kByRule,     nullptr},
};
// clang-format on

const StoppingRule& stopping_rule(Finding finding, NoticedBy noticed_by) {
  for (const StoppingRule& rule : kStoppingRules) {
    if (rule.finding == finding && rule.noticed_by == noticed_by) return rule;
  }
  throw std::logic_error(std::string("no rule says how the motors stop for ") + info(finding).name);
}

bool bus_silent(const std::vector<EcuLink>& links) {
  // The first ECUs may have answered the SYNC during which it fell silent, so that they have missed
  // one less.
  const auto answered_once = [](const EcuLink& link) { return link.sample_time() > 0.0; };
  const auto missed = [](const EcuLink& link) { return !link.answered_last(); };
  const auto lost = [](const EcuLink& link) { return !link.alive(); };
  return links.size() > 1 && std::all_of(links.begin(), links.end(), answered_once) &&
         std::all_of(links.begin(), links.end(), missed) &&
         std::any_of(links.begin(), links.end(), lost);
}

bool is_lost(const EcuLink& link, double now) {
  const bool measured = link.sample_time() > 0.0;
  return link.heard() && !link.alive() && (measured || now - link.heard_since() > kFirstAnswer);
}

}  // namespace driver
}  // namespace anthrob
