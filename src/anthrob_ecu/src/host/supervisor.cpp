#include "anthrob_ecu/supervisor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "anthrob_core/nearest_name.h"

namespace anthrob {
namespace ecu {

namespace {

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%g", value);
  return buffer;
}

std::string others(const std::string& name, const std::vector<MuscleChannel>& muscles) {
  std::vector<std::string> names;
  for (const MuscleChannel& muscle : muscles) names.push_back(muscle.name);
  return expected_names(name, names);
}

const char* const kModeNames[kModeCount] = {"VOLTAGE", "POSITION", "CURRENT", "FORCE"};
const char* const kModeUnits[kModeCount] = {"V", "rad", "A", "N"};

}  // namespace

Supervisor::Supervisor(std::vector<MuscleChannel> muscles, const Options& options)
    : muscles_(std::move(muscles)), options_(options) {
  for (const MuscleChannel& muscle : muscles_) {
    // A muscle without ECU stands for itself.
    const std::string ecu = muscle.ecu.empty() ? muscle.name : muscle.ecu;
    auto it = std::find(ecus_.begin(), ecus_.end(), ecu);
    if (it == ecus_.end()) it = ecus_.insert(ecus_.end(), ecu);
    ecu_of_.push_back(static_cast<std::size_t>(it - ecus_.begin()));
  }
  machines_.resize(ecus_.size());
  owners_.resize(muscles_.size());
  zero_lost_.resize(ecus_.size());
  handle_all(Event::kSelfTestPassed);
  if (options_.auto_enable) handle_all(Event::kEnable);
}

bool Supervisor::handle_all(Event event) {
  bool all = true;
  for (StateMachine& machine : machines_) all = machine.handle(event) && all;
  return all;
}

bool Supervisor::stop_latched() const {
  return std::any_of(machines_.begin(), machines_.end(),
                     [](const StateMachine& machine) { return machine.stop_latched(); });
}

std::optional<std::string> Supervisor::check(const std::vector<std::string>& names,
                                             const std::vector<std::uint8_t>& modes,
                                             const std::vector<double>& references,
                                             std::vector<MuscleReference>& accepted) const {
  if (names.empty()) return "no muscle: the command has no names";
  if (modes.size() != names.size() || references.size() != names.size()) {
    return std::to_string(names.size()) + " names, " + std::to_string(modes.size()) + " modes, " +
           std::to_string(references.size()) + " references: expected equal numbers";
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto it = std::find_if(muscles_.begin(), muscles_.end(),
                                 [&](const MuscleChannel& m) { return m.name == names[i]; });
    if (it == muscles_.end())
      return "muscle '" + names[i] + "': no such muscle" + others(names[i], muscles_);
    const std::string who = "muscle '" + names[i] + "': ";
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      return who + "named twice";
    }
    if (!it->takes_commands) return who + "is passive and takes no command";
    if (modes[i] >= kModeCount) {
      return who + "mode " + std::to_string(modes[i]) +
             ": expected VOLTAGE, POSITION, CURRENT or FORCE";
    }
    if (!it->modes[modes[i]]) return who + "has no mode " + kModeNames[modes[i]];
    const auto muscle = it - muscles_.begin();
    const std::size_t ecu = ecu_of_[static_cast<std::size_t>(muscle)];
    if (static_cast<Mode>(modes[i]) == Mode::kPosition && zero_lost_[ecu]) {
      return who + ecus_[ecu] + " has no zero: call home first";
    }
    const double reference = references[i];
    if (!std::isfinite(reference)) return who + "reference is not a finite number";
    if (reference < it->lowest[modes[i]] || reference > it->highest[modes[i]]) {
      return who + kModeNames[modes[i]] + " " + text(reference) + " " + kModeUnits[modes[i]] +
             ": expected " + text(it->lowest[modes[i]]) + " to " + text(it->highest[modes[i]]);
    }
    accepted.push_back({static_cast<int>(muscle), static_cast<Mode>(modes[i]), reference});
  }
  return std::nullopt;
}

Supervisor::Outcome Supervisor::command(const std::vector<std::string>& names,
                                        const std::vector<std::uint8_t>& modes,
                                        const std::vector<double>& references, double time,
                                        std::vector<MuscleReference>& accepted,
                                        const std::string& sender) {
  accepted.clear();
  std::vector<MuscleReference> checked;
  if (const auto reason = check(names, modes, references, checked)) return refuse(*reason);
  if (options_.auto_enable && timed_out_) {
    // What was disabled stays so; a latched stop or a fault refuses this event.
    for (StateMachine& machine : machines_) {
      if (machine.state() == State::kStopping) machine.handle(Event::kEnable);
    }
    timed_out_ = false;
  }
  for (const MuscleReference& reference : checked) {
    if (!follows_references(reference.muscle)) return refuse(why_stopped(reference.muscle));
  }
  if (const auto reason = taken(checked, time, sender)) return refuse(*reason);
  for (const MuscleReference& reference : checked)
    owners_[static_cast<std::size_t>(reference.muscle)] = {sender, time};
  commanded_ = true;
  last_command_ = std::max(last_command_, time);
  accepted = std::move(checked);
  return {true, ""};
}

double Supervisor::hold() const {
  // Half of what stops the motors, so that the next one can take over without a stop.
  const double timeout =
      options_.command_timeout > 0.0 ? options_.command_timeout : Options().command_timeout;
  return 0.5 * timeout;
}

std::optional<std::string> Supervisor::taken(const std::vector<MuscleReference>& muscles,
                                             double time, const std::string& sender) const {
  if (sender.empty()) return std::nullopt;
  for (const MuscleReference& reference : muscles) {
    const auto muscle = static_cast<std::size_t>(reference.muscle);
    const Owner& owner = owners_[muscle];
    // Simulated time may be set back.
    const bool current = time >= owner.time && time - owner.time <= hold();
    if (owner.sender.empty() || owner.sender == sender || !current) continue;
    return "muscle '" + muscles_[muscle].name + "' is commanded by " + owner.sender + "; " +
           sender + " may command it once that has been silent for " + text(hold()) + " s";
  }
  return std::nullopt;
}

void Supervisor::forget_owners() {
  owners_.assign(muscles_.size(), {});
}

Supervisor::Outcome Supervisor::refuse(const std::string& reason) {
  ++rejected_;
  last_rejection_ = reason;
  return {false, reason};
}

std::string Supervisor::why_stopped(int muscle) const {
  if (stop_latched()) return "emergency stop is latched: call clear_faults, then enable";
  if (state(muscle) == State::kFault) {
    return ecus_[ecu_of_[static_cast<std::size_t>(muscle)]] +
           " is in FAULT: call clear_faults, then enable";
  }
  return "not enabled: call enable";
}

Supervisor::Outcome Supervisor::enable(double time) {
  if (stop_latched()) return {false, "emergency stop is latched: call clear_faults first"};
  for (std::size_t i = 0; i < machines_.size(); ++i) {
    if (machines_[i].state() == State::kFault) {
      return {false, ecus_[i] + " is in FAULT: call clear_faults first"};
    }
  }
  const bool running =
      std::all_of(machines_.begin(), machines_.end(),
                  [](const StateMachine& machine) { return machine.state() == State::kEnabled; });
  // What runs stays watched: else its motors would follow the last command for ever.
  if (running && !machines_.empty()) return {true, "already enabled"};
  handle_all(Event::kEnable);
  // The watch starts with the first command after enabling.
  commanded_ = timed_out_ = false;
  last_command_ = time;
  return {true, ""};
}

Supervisor::Outcome Supervisor::disable() {
  handle_all(Event::kDisable);
  forget_owners();
  commanded_ = timed_out_ = false;
  return {true, ""};
}

Supervisor::Outcome Supervisor::emergency_stop() {
  handle_all(Event::kEmergencyStop);
  forget_owners();
  commanded_ = timed_out_ = false;
  return {true, ""};
}

Supervisor::Outcome Supervisor::clear_faults() {
  bool enabled = false, failed = false;
  for (const StateMachine& machine : machines_) {
    enabled = enabled || machine.follows_references();
    failed = failed || machine.state() == State::kFault;
  }
  if (enabled && !failed && !stop_latched()) return {true, "nothing to clear"};
  handle_all(Event::kClear);
  return {true, ""};
}

Supervisor::Outcome Supervisor::fault(const std::string& ecu) {
  for (std::size_t i = 0; i < ecus_.size(); ++i) {
    if (ecus_[i] != ecu) continue;
    machines_[i].handle(Event::kFaultDetected);
    return {true, ""};
  }
  return {false, "no ECU of that name"};
}

void Supervisor::lose_zero(const std::string& ecu) {
  set_zero_lost(ecu, true);
}

void Supervisor::regain_zero(const std::string& ecu) {
  set_zero_lost(ecu, false);
}

void Supervisor::set_zero_lost(const std::string& ecu, bool lost) {
  for (std::size_t i = 0; i < ecus_.size(); ++i) {
    if (ecus_[i] == ecu) zero_lost_[i] = lost;
  }
}

bool Supervisor::update(double time) {
  // Simulated time may be set back; an age cannot be negative.
  if (time < last_command_) last_command_ = time;
  if (options_.command_timeout <= 0.0 || !commanded_) return false;
  if (time - last_command_ <= options_.command_timeout) return false;
  bool stopped = false;
  for (StateMachine& machine : machines_)
    stopped = machine.handle(Event::kCommandTimeout) || stopped;
  timed_out_ = timed_out_ || stopped;
  return stopped;
}

}  // namespace ecu
}  // namespace anthrob
