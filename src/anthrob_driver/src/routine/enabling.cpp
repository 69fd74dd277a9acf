#include "routine/enabling.h"

namespace anthrob {
namespace driver {

namespace {

constexpr double kRetry = 0.05;  // [s] between two requests to one ECU

}  // namespace

void Enabling::start(std::size_t ecus, double now) {
  deadline_ = now + kTimeout;
  retry_ = now;
  sequence_.assign(ecus, 0);
  refusal_.clear();
}

Enabling::State Enabling::step(const std::vector<EcuLink>& links, double now, const Ask& ask) {
  const bool retry = now >= retry_;
  if (retry) retry_ = now + kRetry;
  bool all = true;
  for (std::size_t e = 0; e < links.size(); ++e) {
    const EcuLink& link = links[e];
    const ecu::StateReport& report = link.report();
    const bool answered = sequence_[e] != 0 && report.sequence == sequence_[e];
    if (answered && report.refusal != ecu::Refusal::kAccepted) {
      refusal_ = link.own().name + " refuses enable: " + ecu::name(report.refusal) +
                 " (docs/ecu_protocol.md, Refusals)";
      return State::kRefused;
    }
    if (answered && report.state == ecu::State::kEnabled) continue;
    all = false;
    if (retry) sequence_[e] = ask(link);
    if (now >= deadline_) {
      refusal_ = link.own().name + " did not confirm enable in time";
      return State::kRefused;
    }
  }
  return all ? State::kConfirmed : State::kWaiting;
}

}  // namespace driver
}  // namespace anthrob
