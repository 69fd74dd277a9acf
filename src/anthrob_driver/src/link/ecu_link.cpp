#include "link/ecu_link.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace anthrob {
namespace driver {

namespace {
using ecu::Function;
constexpr unsigned kMotionPart[] = {1, 2}, kEffortPart = 4;
}  // namespace

EcuLink::EcuLink(const Hardware& hardware, int index, Findings& findings)
    : hardware_(hardware), index_(index), findings_(findings) {
  wanted_ = kMotionPart[0] | kEffortPart | (own().muscles.size() > 1 ? kMotionPart[1] : 0);
}

void EcuLink::start_cycle(std::uint8_t counter, double now) {
  if (started_ && sampled_ && got_ != wanted_) {
    if (unanswered_ < kLostSyncs) ++unanswered_;
    findings_.add(Finding::kLostFrame, index_, now);
  }
  started_ = true;
  returning_ = sampled_ && unanswered_ >= kLostSyncs;
  counter_ = static_cast<std::uint8_t>(counter & 0xF);
  got_ = 0;
  got_analog_ = false;
}

void EcuLink::receive(const ecu::Frame& frame, double now) {
  switch (static_cast<Function>(ecu::function_of(frame))) {
    case Function::kMotionA:
    case Function::kMotionB: {
      const int channel = ecu::function_of(frame) == static_cast<int>(Function::kMotionB);
      const ecu::Motion motion = ecu::decode_motion(frame);
      if (!take_part(kMotionPart[channel], motion.counter, now)) break;
      incoming_.motion[channel] = motion;
      finish_answer(now);
      break;
    }
    case Function::kEffort: {
      const ecu::Effort effort = ecu::decode_effort(frame);
      if (!take_part(kEffortPart, effort.counter, now)) break;
      incoming_.effort = effort;
      finish_answer(now);
      break;
    }
    case Function::kAnalog: {
      const ecu::Analog analog = ecu::decode_analog(frame);
      // Given out twice it would be two measurements at one instant.
      if (!started_ || returning_ || got_analog_ || analog.counter != counter_) break;
      analog_ = analog;
      got_analog_ = analog_new_ = true;
      break;
    }
    case Function::kState:
      on_report(ecu::decode_state(frame), now);
      break;
    case Function::kParameterReply:
      on_reply(ecu::decode_parameter(frame), now);
      break;
    case Function::kHealth:
      health_ = ecu::decode_health(frame);
      health_time_ = now;
      break;
    default:
      break;  // only a host sends those
  }
}

bool EcuLink::take_part(unsigned part, std::uint8_t counter, double now) {
  // An answer to another SYNC is old, or comes a second time: it must not pass for new.
  if (!started_ || counter != counter_ || (got_ & part) != 0 || (wanted_ & part) == 0) {
    findings_.add(Finding::kRepeatedFrame, index_, now);
    return false;
  }
  got_ |= part;
  return true;
}

void EcuLink::finish_answer(double now) {
  if (got_ != wanted_) return;
  unanswered_ = 0;
  if (returning_) return;
  sample_ = incoming_;
  sampled_ = true;
  sample_time_ = now;
  take_state(sample_.motion[0].state);
  take_latched(sample_.motion[0].stop_latched);
}

void EcuLink::take_latched(bool latched) {
  if (latched_ && !latched) own_stop_ = false;
  latched_ = latched;
}

void EcuLink::take_state(ecu::State state) {
  if ((state == ecu::State::kFault) != (state_ == ecu::State::kFault)) {
    // Some faults lose the zero, also without a report while in FAULT: only the unit knows.
    std::replace(zeros_.begin(), zeros_.end(), Zero::kKnown, Zero::kNotTold);
  }
  state_ = state;
}

void EcuLink::on_report(const ecu::StateReport& report, double now) {
  if (report.version != ecu::kProtocolVersion) {
    wrong_version_ = true;
    other_version_ = "version " + std::to_string(report.version) + ", expected " +
                     std::to_string(ecu::kProtocolVersion);
    findings_.add(Finding::kWrongVersion, index_, now, *other_version_);
    return;
  }
  if (heard_ && report.session != report_.session) {
    restarted_ = true;
    begin_upload_anew();
    waiting_ = false;
    zeros_.fill(Zero::kNotTold);
    findings_.add(Finding::kEcuRestarted, index_, now);
  }
  if (!heard_) heard_since_ = now;
  heard_ = true;
  report_ = report;
  if (configured()) begin_upload_anew();  // should another one be needed
  take_state(report.state);
  take_latched(report.stop_latched);
}

const MuscleHardware& EcuLink::muscle(int channel) const {
  const int last = static_cast<int>(own().muscles.size()) - 1;
  const int index = own().muscles[static_cast<std::size_t>(std::min(channel, last))];
  return hardware_.muscles[static_cast<std::size_t>(index)];
}

bool EcuLink::take_restart() {
  return std::exchange(restarted_, false);
}

bool EcuLink::take_wrong_version() {
  return std::exchange(wrong_version_, false);
}

bool EcuLink::take_analog() {
  return std::exchange(analog_new_, false);
}

/// What a sensor's counts mean comes before the limits that watch it.
int EcuLink::wanted_index() const {
  constexpr int kFirst = static_cast<int>(ecu::Parameter::kEncoderScale);
  return (next_ + kFirst) % ecu::kParameterCount;
}

float EcuLink::wanted_value() const {
  const int muscle = own().muscles[static_cast<std::size_t>(next_ / ecu::kParameterCount)];
  return hardware_.muscles[static_cast<std::size_t>(muscle)].parameters.raw(wanted_index());
}

void EcuLink::begin_upload_anew() {
  next_ = passes_ = 0;
  if (asked_ == Asked::kConfiguration) waiting_ = false;
}

bool EcuLink::next_parameter(double now, ecu::Frame& frame) {
  const int count = static_cast<int>(own().muscles.size()) * ecu::kParameterCount;
  if (!heard_ || configured() || now < resume_) return false;
  if (waiting_ && now - sent_ < kReplyTimeout) return false;
  if (next_ >= count) {
    // All was read back, yet the checksum differs: once more, not too fast.
    if (++passes_ > 1) {
      findings_.add(Finding::kConfigurationRefused, index_, now,
                    "every parameter reads back right, but the checksum of all does not fit: the "
                    "ECU has another number of muscles than in hardware.yaml, or other firmware");
    }
    next_ = 0;
    resume_ = now + kRetryPause;
    return false;
  }
  ecu::ParameterMessage message;
  message.muscle = static_cast<std::uint8_t>(next_ / ecu::kParameterCount);
  message.index = static_cast<std::uint8_t>(wanted_index());
  message.value = wanted_value();
  message.write = true;
  frame = ask(Asked::kConfiguration, message, now);
  return true;
}

ecu::Frame EcuLink::ask(Asked what, ecu::ParameterMessage& message, double now) {
  message.sequence = ++sequence_;
  waiting_ = true;
  asked_ = what;
  sent_ = now;
  return ecu::encode_parameter_request(message, own().node);
}

void EcuLink::start_write(int channel, ecu::Parameter parameter, float value) {
  written_ = {};
  written_.muscle = static_cast<std::uint8_t>(channel);
  written_.index = static_cast<std::uint8_t>(parameter);
  written_.value = value;
  written_.write = true;
  write_ = Write::kAsked;
  waiting_ = false;
}

bool EcuLink::next_write(double now, ecu::Frame& frame) {
  if (write_ != Write::kAsked || (waiting_ && now - sent_ < kReplyTimeout)) return false;
  frame = ask(Asked::kGain, written_, now);
  return true;
}

void EcuLink::expect_configuration(double now) {
  begin_upload_anew();
  waiting_ = false;  // what was asked before is answered in vain
  resume_ = now + kRetryPause;
}

bool EcuLink::zero_known() const {
  const auto end = zeros_.begin() + static_cast<std::ptrdiff_t>(own().muscles.size());
  return std::all_of(zeros_.begin(), end, [](Zero zero) { return zero == Zero::kKnown; });
}

void EcuLink::revoke_zero(int channel) {
  zeros_[static_cast<std::size_t>(channel)] = Zero::kRevoked;
  // The answer that is on its way is about the zero as it was.
  const bool is_written = asked_ == Asked::kZero && zero_ == static_cast<std::size_t>(channel);
  if (asked_ == Asked::kZeroKnown || is_written) waiting_ = false;
}

bool EcuLink::next_zero_question(double now, ecu::Frame& frame) {
  if (!configured() || write_ == Write::kAsked) return false;
  if (waiting_ && now - sent_ < kReplyTimeout) return false;
  for (std::size_t c = 0; c < own().muscles.size(); ++c) {
    if (zeros_[c] != Zero::kNotTold && zeros_[c] != Zero::kRevoked) continue;
    ecu::ParameterMessage message;
    message.muscle = static_cast<std::uint8_t>(c);
    message.index = ecu::kZeroKnown;
    message.write = zeros_[c] == Zero::kRevoked;
    frame = ask(Asked::kZeroKnown, message, now);
    return true;
  }
  return false;
}

void EcuLink::start_zero() {
  for (std::size_t c = 0; c < own().muscles.size(); ++c) {
    const auto muscle = static_cast<std::size_t>(own().muscles[c]);
    const bool pulled = hardware_.muscles[muscle].parameters.has_force_sensor();
    // From here on it is the old one or the new one. If home ends before it is confirmed, a robot
    // with some zeros of each must not take positions.
    if (pulled || zeros_[c] != Zero::kKnown) zeros_[c] = Zero::kRevoked;
  }
  zero_ = 0;
  zero_refused_ = waiting_ = false;
  skip_zeros_to_keep();
}

void EcuLink::skip_zeros_to_keep() {
  while (!zeroed() && zeros_[zero_] != Zero::kRevoked) ++zero_;
}

const MuscleHardware& EcuLink::zeroing() const {
  return hardware_.muscles[static_cast<std::size_t>(own().muscles[zero_])];
}

bool EcuLink::next_zero(double now, ecu::Frame& frame) {
  if (zeroed() || (waiting_ && now - sent_ < kReplyTimeout)) return false;
  ecu::ParameterMessage message;
  message.muscle = static_cast<std::uint8_t>(zero_);
  message.index = ecu::kPresentPosition;
  message.value = static_cast<float>(zeroing().home_position);
  message.write = true;
  frame = ask(Asked::kZero, message, now);
  return true;
}

void EcuLink::on_zero_reply(const ecu::ParameterMessage& reply) {
  const bool taken = reply.result == ecu::ParameterResult::kOk &&
                     reply.index == ecu::kPresentPosition && reply.muscle == zero_;
  zero_refused_ = !taken;
  if (!taken) return;
  zeros_[zero_] = Zero::kKnown;
  skip_zeros_to_keep();
}

void EcuLink::on_zero_answer(const ecu::ParameterMessage& reply) {
  if (reply.index != ecu::kZeroKnown || reply.muscle >= own().muscles.size()) return;
  Zero& zero = zeros_[reply.muscle];
  // Also of a unit that does not understand the question.
  const bool known = reply.result == ecu::ParameterResult::kOk && reply.value == 1.0f;
  zero = known && zero == Zero::kNotTold ? Zero::kKnown : Zero::kLost;
}

void EcuLink::on_reply(const ecu::ParameterMessage& reply, double now) {
  if (!waiting_ || reply.sequence != sequence_) return;
  waiting_ = false;
  if (asked_ == Asked::kGain) {
    const bool taken = reply.result == ecu::ParameterResult::kOk && reply.index == written_.index &&
                       reply.muscle == written_.muscle && reply.value == written_.value;
    if (write_ == Write::kAsked) write_ = taken ? Write::kTaken : Write::kRefused;
    return;
  }
  if (asked_ == Asked::kZero) return on_zero_reply(reply);
  if (asked_ == Asked::kZeroKnown) return on_zero_answer(reply);
  const int index = wanted_index();
  if (reply.result == ecu::ParameterResult::kOk && reply.index == index &&
      reply.value == wanted_value()) {
    ++next_;
    return;
  }
  const int channel = next_ / ecu::kParameterCount;
  char text[128];
  std::snprintf(text, sizeof(text), ": %s: wrote %g, read back %g: %s",
                ecu::kParameters[index].name, static_cast<double>(wanted_value()),
                static_cast<double>(reply.value), ecu::name(reply.result));
  // An ECU without that muscle knows none of its parameters.
  const bool fewer = channel > 0 && reply.result == ecu::ParameterResult::kUnknown;
  findings_.add(Finding::kConfigurationRefused, index_, now,
                muscle(channel).name + text +
                    (fewer ? "; has the ECU as many muscles as in hardware.yaml?" : ""));
  resume_ = now + kRetryPause;
}

std::optional<std::string> EcuLink::why_not_enable() const {
  if (!heard_ && other_version_) return "speaks another protocol: " + *other_version_;
  if (!heard_) return "was never heard; is it switched on?";
  if (!alive()) return "does not answer; check its power and cable";
  if (!configured()) return "is being configured; try again in a second";
  if (report_.fault == ecu::Fault::kSelfTest)
    return "its self test failed: check its current sensors, then switch it off and on";
  if (state_ == ecu::State::kFault) {
    return std::string("fault ") + ecu::name(report_.fault) + ": call clear_faults first";
  }
  if (latched_) return "holds an emergency stop: call clear_faults first";
  return std::nullopt;
}

std::optional<std::string> EcuLink::not_cleared() const {
  if (!heard_) return std::nullopt;
  if (!alive()) return "does not answer; check its power and cable";
  if (state_ == ecu::State::kFault) {
    return std::string("fault ") + ecu::name(report_.fault) + " persists";
  }
  if (latched_) return "holds its emergency stop";
  return std::nullopt;
}

}  // namespace driver
}  // namespace anthrob
