#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <string>

#include "anthrob_driver/findings.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_ecu/protocol.h"

namespace anthrob {
namespace driver {

/// One ECU as the driver sees it: what it reported last, how old that is, and whether it holds the
/// right configuration.
class EcuLink {
 public:
  /// After so many SYNCs in a row without an answer an ECU counts as lost: at 200 Hz the others get
  /// zero volts within 20 ms. SYNCs, not time, are counted, so that a late host does not blame
  /// ECUs.
  static constexpr int kLostSyncs = 2;
  /// While motors are enabled, the bus has room for one parameter in so many cycles, of all ECUs
  /// together.
  static constexpr int kCyclesPerWrite = 4;
  static constexpr double kReplyTimeout = 0.05;  ///< [s] of a parameter, then it is sent again
  static constexpr double kRetryPause = 1.0;     ///< [s] after a refused parameter
  static constexpr double kHealthAge = 1.5;      ///< [s] HEALTH comes every half second

  /// @param hardware, findings must outlive the link   @param index of this ECU, for findings
  EcuLink(const Hardware& hardware, int index, Findings& findings);

  /// A SYNC with this counter is about to be sent: answers to older ones no longer count.
  void start_cycle(std::uint8_t counter, double now);
  /// A good frame of this node.
  void receive(const ecu::Frame& frame, double now);
  /// @return the next parameter frame to send, if there is one to send now
  bool next_parameter(double now, ecu::Frame& frame);

  /// Whether this ECU has reported, in this session, that all its muscles have a zero. The driver
  /// asks it once it is configured, and again after every fault.
  bool zero_known() const;
  /// This muscle's zero no longer holds. The ECU is told so, because it may outlive this driver.
  void revoke_zero(int channel);
  /// @return whether `frame` is the next of these, to be sent now
  bool next_zero_question(double now, ecu::Frame& frame);

  /// Begins to set the positions of its muscles to their home_position: of the muscles with a force
  /// sensor, which were pulled, and of those that have no zero anyway.
  void start_zero();
  /// @return whether `frame` is the next write of a position, to be sent now
  bool next_zero(double now, ecu::Frame& frame);
  /// Whether all of them were confirmed, or none was to be written.
  bool zeroed() const { return zero_ == own().muscles.size(); }
  bool zero_refused() const { return zero_refused_; }
  /// The muscle whose zero is not confirmed yet. Must not be called if zeroed().
  const MuscleHardware& zeroing() const;

  /// Begins to write a gain; write() shows the result.
  void start_write(int channel, ecu::Parameter parameter, float value);
  /// @return whether `frame` is the write, to be sent now
  bool next_write(double now, ecu::Frame& frame);
  enum class Write { kNone, kAsked, kTaken, kRefused };
  Write write() const { return write_; }
  void end_write() { write_ = Write::kNone; }
  /// The configuration that the ECU should hold has changed. Its report of the new one may still be
  /// on its way; only if none comes is the configuration written again.
  void expect_configuration(double now);

  bool heard() const { return heard_; }
  /// Time of its first report [s]; 0 if none came.
  double heard_since() const { return heard_since_; }
  /// Whether it answers.
  bool alive() const { return sampled_ && !returning_ && unanswered_ < kLostSyncs; }
  /// Whether it completely answered the last SYNC but one; the current one is still open.
  bool answered_last() const { return unanswered_ == 0; }
  bool configured() const { return heard_ && report_.configuration == own().configuration; }
  /// Whether all frames that answer the current SYNC have arrived. False for the first answer of an
  /// ECU that was lost: an old frame from its controller could pass for a new one, because the
  /// counter has only four bits.
  bool complete() const { return got_ == wanted_ && !returning_; }
  /// Whether the session has changed, so that the ECU has restarted. True once for each restart.
  bool take_restart();
  /// Whether a report in another version of the protocol came, perhaps from a second ECU with this
  /// node number. True once.
  bool take_wrong_version();
  /// Which other version was reported last, if one was.
  const std::optional<std::string>& other_version() const { return other_version_; }

  /// Of the last complete answer.
  const ecu::Motion& motion(int channel) const { return sample_.motion[channel]; }
  const ecu::Effort& effort() const { return sample_.effort; }
  const ecu::Analog& analog() const { return analog_; }
  /// Whether analog() is of the current SYNC; true once.
  bool take_analog();
  const ecu::StateReport& report() const { return report_; }
  const ecu::Health& health() const { return health_; }
  /// Whether health() was sent not long ago. Not every ECU sends it.
  bool health_known(double now) const { return alive() && now - health_time_ <= kHealthAge; }
  double sample_time() const { return sample_time_; }
  ecu::State state() const { return state_; }
  bool stop_latched() const { return latched_; }
  /// This driver sends STOP. The ECU may hold it long after, if no CLEAR reaches it.
  void stop_sent() { own_stop_ = true; }
  bool holds_own_stop() const { return latched_ && own_stop_; }
  /// Why it cannot be enabled, if it cannot.
  std::optional<std::string> why_not_enable() const;
  /// What clear_faults did not clear; none of an ECU that was never heard.
  std::optional<std::string> not_cleared() const;

  /// @param channel that a frame names; the last muscle if there is none
  const MuscleHardware& muscle(int channel) const;

  const EcuHardware& own() const { return hardware_.ecus[static_cast<std::size_t>(index_)]; }

 private:
  enum class Asked { kConfiguration, kZero, kZeroKnown, kGain };
  /// State of one muscle's zero. kRevoked: the ECU must still be told, or be given a new one.
  enum class Zero { kNotTold, kRevoked, kLost, kKnown };
  struct Sample {
    ecu::Motion motion[ecu::kMusclesPerEcu];
    ecu::Effort effort;
  };

  /// Whether this part of the answer belongs to the current SYNC and comes for the first time; only
  /// then do its values count.
  bool take_part(unsigned part, std::uint8_t counter, double now);
  void finish_answer(double now);
  void take_state(ecu::State state);
  void take_latched(bool latched);
  void on_report(const ecu::StateReport& report, double now);
  void on_reply(const ecu::ParameterMessage& reply, double now);
  void on_zero_reply(const ecu::ParameterMessage& reply);
  void on_zero_answer(const ecu::ParameterMessage& reply);
  /// @param message its sequence number is filled in
  ecu::Frame ask(Asked what, ecu::ParameterMessage& message, double now);
  void begin_upload_anew();
  int wanted_index() const;
  float wanted_value() const;
  void skip_zeros_to_keep();

  const Hardware& hardware_;
  int index_;
  Findings& findings_;
  unsigned wanted_;  ///< bits of the frames that make an answer
  unsigned got_ = 0;
  int unanswered_ = 0;        ///< SYNCs since the last complete answer
  bool returning_ = false;    ///< was lost until the current SYNC
  std::uint8_t counter_ = 0;  ///< low four bits of the SYNC's
  bool started_ = false;
  Sample incoming_, sample_;
  ecu::Analog analog_;
  bool analog_new_ = false, got_analog_ = false;
  ecu::StateReport report_;
  ecu::Health health_;
  ecu::State state_ = ecu::State::kBoot;
  bool latched_ = false;
  bool own_stop_ = false;  ///< sent, and not seen cleared since
  bool heard_ = false, sampled_ = false, restarted_ = false, wrong_version_ = false;
  std::optional<std::string> other_version_;
  double sample_time_ = 0.0, heard_since_ = 0.0, health_time_ = -HUGE_VAL;

  // Upload of the configuration: one parameter at a time, each read back.
  int next_ = 0;
  int passes_ = 0;  ///< over all parameters, since it was configured or started
  std::uint8_t sequence_ = 0;
  bool waiting_ = false;  ///< for a reply
  Asked asked_ = Asked::kConfiguration;
  double sent_ = 0.0, resume_ = 0.0;
  std::array<Zero, ecu::kMusclesPerEcu> zeros_{};  ///< by channel
  std::size_t zero_ = 0;                           ///< channel whose new one is written
  bool zero_refused_ = false;
  Write write_ = Write::kNone;
  ecu::ParameterMessage written_;
};

}  // namespace driver
}  // namespace anthrob
