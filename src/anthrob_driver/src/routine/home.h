#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_driver/hardware.h"

namespace anthrob {
namespace driver {

/// Homing. It winds all tendons in slowly until they grip, brings them to a common tension by force
/// control, and then makes this posture the zero. Meanwhile it watches for tendons that are broken,
/// slack, slip or wind the wrong way. Muscles without force sensor are not pulled, and get a zero
/// only if they have none.
class Home {
 public:
  struct Reading {
    double position, force;  ///< [rad], [N]; NaN: no answer to this SYNC; only force NaN: no sensor
  };
  enum class State { kIdle, kRunning, kReached, kFailed };

  explicit Home(const Hardware& hardware) : hardware_(hardware) {}

  /// @param now [s] here and below, of a clock that never jumps
  void start(double now);
  /// One cycle. @param readings one for each muscle
  void step(const std::vector<Reading>& readings, double now);
  /// One cycle while the zeros are being written. Positions jump meanwhile, so only forces are
  /// watched.
  void hold(const std::vector<Reading>& readings);
  void abort(const std::string& reason);
  /// All ECUs have confirmed the zero.
  void finish() { state_ = State::kIdle; }

  State state() const { return state_; }
  bool running() const { return state_ == State::kRunning || state_ == State::kReached; }
  /// Why it failed; none after success.
  const std::optional<std::string>& failure() const { return failure_; }
  /// Whether this muscle's tendon broke, slipped, is off its pulley or did not grip in time.
  bool tendon_lost(std::size_t muscle) const {
    return muscle < tendons_.size() && tendons_[muscle].lost;
  }
  /// What a muscle is to do in this cycle.
  ecu::MuscleReference command(std::size_t muscle, double now) const;

 private:
  struct Tendon {
    double start = 0.0;    ///< [rad]
    bool gripped = false;  ///< has reached half the pretension
    double grip = 0.0;     ///< [rad] position at which it did
    bool held = false;     ///< has exceeded four fifths of the pretension
    bool lost = false;     ///< see tendon_lost()
  };
  bool pulls(std::size_t muscle) const;
  /// Names of the muscles that are to be pulled but have no measurement in this cycle.
  std::string unknown(const std::vector<Reading>& readings) const;
  bool begin(const std::vector<Reading>& readings, double now);
  /// What is wrong with a tendon.
  std::optional<std::string> check(const Reading& reading, Tendon& tendon) const;
  std::optional<std::string> check_force(const Reading& reading) const;
  std::optional<std::string> check_grip(const Reading& reading, Tendon& tendon) const;

  const Hardware& hardware_;
  State state_ = State::kIdle;
  std::optional<std::string> failure_;
  std::vector<Tendon> tendons_;
  bool begun_ = false;  ///< with a measurement of every tendon
  double started_ = 0.0, settled_ = 0.0;
};

}  // namespace driver
}  // namespace anthrob
