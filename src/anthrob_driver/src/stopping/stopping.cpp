#include "stopping/stopping.h"

namespace anthrob {
namespace driver {

namespace {

constexpr double kReasonTime = 0.15;  // [s] for a STATE, sent every 0.1 s and when it changes

}  // namespace

std::string Stopping::reason(Finding finding, std::optional<int> ecu,
                             const std::string& detail) const {
  return (ecu ? prefix(*ecu) : "") + info(finding).meaning +
         (detail.empty() ? "" : " (" + detail + ")");
}

std::optional<std::string> Stopping::fault_of(int ecu) const {
  const EcuLink& link = links_[static_cast<std::size_t>(ecu)];
  const ecu::StateReport& report = link.report();
  if (report.fault == ecu::Fault::kNone) return std::nullopt;
  const std::string name = ecu::name(report.fault);
  return ecu::concerns_unit(report.fault) ? name : name + " of " + link.muscle(report.muscle).name;
}

std::string Stopping::prefix(int ecu) const {
  return links_[static_cast<std::size_t>(ecu)].own().name + ": ";
}

const char* Stopping::remedy_of(Finding finding, int ecu) const {
  const auto fault = static_cast<std::size_t>(links_[static_cast<std::size_t>(ecu)].report().fault);
  const bool known = fault > 0 && fault < ecu::kFaultCount;
  return known ? ecu::kFaults[fault].remedy : info(finding).remedy;
}

void Stopping::record(Finding finding, const std::string& what, const char* remedy) {
  log_.add(std::string(info(finding).name) + ": " + what + "; " +
           (remedy ? remedy : info(finding).remedy));
}

void Stopping::expect_reason(Finding finding, int ecu, const std::string& told, double now) {
  waiting_ = Waiting{finding, ecu, now + kReasonTime, told};
}

std::optional<Stopping::Explained> Stopping::take_reason(double now) {
  if (!waiting_) return std::nullopt;
  const Waiting stop = *waiting_;
  const auto fault = fault_of(stop.ecu);
  if (!fault && now < stop.until) return std::nullopt;
  waiting_.reset();
  return Explained{stop.finding,
                   stop.ecu,
                   fault,
                   stop.told,
                   reason(stop.finding, stop.ecu, fault.value_or("")),
                   remedy_of(stop.finding, stop.ecu)};
}

}  // namespace driver
}  // namespace anthrob
