#pragma once

#include <array>
#include <functional>
#include <string>

#include "anthrob_driver/findings.h"
#include "anthrob_driver/hardware.h"
#include "anthrob_ecu/protocol.h"

namespace anthrob {
namespace driver {

/// One ECU as the driver sees it: what it last said, how old that is, whether it holds the
/// configuration that it should.
class EcuLink {
 public:
  /// That many SYNCs in a row without an answer, and an ECU counts as lost: at 200 Hz the others
  /// get zero volts within 20 ms. Counted, not timed: a host that was late must not blame the ECUs.
  static constexpr int kLostSyncs = 2;
  static constexpr double kReplyTimeout = 0.05;  ///< [s] of a parameter, then it is sent again
  static constexpr double kRetryPause = 1.0;     ///< [s] after a refused parameter

  /// @param hardware, findings must outlive the link   @param index of this ECU, for findings
  EcuLink(const Hardware& hardware, int index, Findings& findings);

  /// A SYNC with this counter goes out now: answers to older ones no longer count.
  void start_cycle(std::uint8_t counter, double now);
  /// A good frame of this node.
  void receive(const ecu::Frame& frame, double now);
  /// @return the next parameter frame to send, if there is one to send now
  bool next_parameter(double now, ecu::Frame& frame);

  /// Whether positions of all its muscles count from a zero, by its own word in this session. It is
  /// asked once it is configured, and again after every fault.
  bool zero_known() const;
  /// This muscle's zero is none any more, and the unit is told so: it outlives this driver.
  void revoke_zero(int channel);
  /// @return whether `frame` is the next of these, to be sent now
  bool next_zero_question(double now, ecu::Frame& frame);

  /// The positions of its muscles are to become their home_position from now on: of those with a
  /// force sensor, which were pulled, and of those that have no zero anyway.
  void start_zero();
  /// @return whether `frame` is the next write of a position, to be sent now
  bool next_zero(double now, ecu::Frame& frame);
  /// All of them were confirmed, or none was asked for.
  bool zeroed() const { return zero_ == own().muscles.size(); }
  bool zero_refused() const { return zero_refused_; }
  /// The muscle whose zero is not confirmed yet; not if zeroed().
  const MuscleHardware& zeroing() const;

  /// A gain is to become this from now on; `write` tells how it went.
  void start_write(int channel, ecu::Parameter parameter, float value);
  /// @return whether `frame` is the write, to be sent now
  bool next_write(double now, ecu::Frame& frame);
  enum class Write { kNone, kAsked, kTaken, kRefused };
  Write write() const { return write_; }
  void end_write() { write_ = Write::kNone; }
  /// The configuration that it should hold has changed: what it reports then may be on its way, and
  /// is written anew only if it does not come.
  void expect_configuration(double now);

  bool heard() const { return heard_; }
  /// Whether it answers.
  bool alive() const { return sampled_ && !returning_ && unanswered_ < kLostSyncs; }
  bool configured() const { return heard_ && report_.configuration == own().configuration; }
  /// All frames of the current SYNC are in. Not so of an ECU that was lost and answers again for
  /// the first time: what waited in its controller meanwhile may pass for an answer, for the
  /// counter has four bits only.
  bool complete() const { return got_ == wanted_ && !returning_; }
  /// Session differs from the first report's: it restarted. True once.
  bool take_restart();
  /// A report in another version of the protocol came, perhaps of a second unit with this number.
  /// True once.
  bool take_wrong_version();
  /// What the last report in another version said; empty: there was none.
  const std::string& other_version() const { return other_version_; }

  /// Of the last complete answer.
  const ecu::Motion& motion(int channel) const { return sample_.motion[channel]; }
  const ecu::Effort& effort() const { return sample_.effort; }
  const ecu::Analog& analog() const { return analog_; }
  /// Whether analog() is of the current SYNC; true once.
  bool take_analog();
  const ecu::StateReport& report() const { return report_; }
  const ecu::Health& health() const { return health_; }
  double sample_time() const { return sample_time_; }
  ecu::State state() const { return state_; }
  bool stop_latched() const { return latched_; }
  /// What keeps it from being enabled; empty: nothing.
  std::string why_not_enable() const;
  /// What clear_faults did not clear, of a unit that answers; empty: nothing.
  std::string not_cleared() const;

  const EcuHardware& own() const { return hardware_.ecus[static_cast<std::size_t>(index_)]; }

 private:
  enum class Asked { kConfiguration, kZero, kZeroKnown, kGain };
  /// Of one muscle. kRevoked: the unit must still be told, or given a new one.
  enum class Zero { kNotTold, kRevoked, kLost, kKnown };
  struct Sample {
    ecu::Motion motion[ecu::kMusclesPerEcu];
    ecu::Effort effort;
  };

  /// Whether this part of the answer is the current SYNC's first; only then its values count.
  bool take_part(unsigned part, std::uint8_t counter, double now);
  void finish_answer(double now);
  void take_state(ecu::State state);
  void on_report(const ecu::StateReport& report, double now);
  void on_reply(const ecu::ParameterMessage& reply, double now);
  void on_zero_reply(const ecu::ParameterMessage& reply);
  void on_zero_answer(const ecu::ParameterMessage& reply);
  /// @param message its sequence number is filled in
  ecu::Frame ask(Asked what, ecu::ParameterMessage& message, double now);
  void begin_upload_anew();
  int wanted_index() const;
  float wanted_value() const;
  void pass_over_unasked_zeros();

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
  bool heard_ = false, sampled_ = false, restarted_ = false, wrong_version_ = false;
  std::string other_version_;
  double sample_time_ = 0.0;

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
