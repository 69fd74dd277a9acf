#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "anthrob_driver/ecu_link.h"
#include "anthrob_driver/slope.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

/// One muscle at one SYNC.
struct MuscleSample {
  bool measured = false;  ///< its ECU answered this SYNC; otherwise the measurements are NaN
  double position = 0.0, velocity = 0.0;  ///< [rad], [rad/s]; gear output, winding in positive
  double current = 0.0;                   ///< [A] motor loop
  double voltage = 0.0;                   ///< [V] output of the controller
  double force = 0.0;                     ///< [N] NaN also if it has no sensor
  double reference = 0.0;                 ///< [V, rad, A or N] sent with this SYNC
  ecu::Mode mode = ecu::Mode::kVoltage;
  ecu::State state = ecu::State::kBoot;  ///< FAULT also if its ECU did not answer
};

/// All muscles at one SYNC.
struct Sample {
  std::int64_t stamp_ns = 0;  ///< wall clock of the kernel when the SYNC was on the wire
  double time = 0.0;          ///< [s] of the driver's clock when the SYNC was sent
  double round_trip = 0.0;    ///< [s] from SYNC and references to the last answer
  std::vector<MuscleSample> muscles;
};

/// Reading of an analogue sensor at one SYNC.
struct AnalogSample {
  enum class Kind { kJoint, kTouch };
  std::int64_t stamp_ns = 0;  ///< as Sample's
  double time = 0.0;          ///< as Sample's
  Kind kind = Kind::kJoint;
  std::size_t sensor = 0;  ///< index in Hardware::joints or touch
  double value = 0.0;      ///< [rad] or [N]
  double rate = 0.0;       ///< [rad/s] of joints; NaN for the first value after a gap
};

/// Collects the answers of the ECUs to one SYNC.
class Sampler {
 public:
  /// @param hardware must outlive the sampler
  explicit Sampler(const Hardware& hardware);

  /// A SYNC goes out now, with these references of all muscles.
  void open(const std::vector<ecu::MuscleReference>& references, double now);
  bool is_open() const { return open_; }
  /// When the SYNC was on the wire [ns], which is when the ECUs measured.
  void on_wire(std::int64_t stamp_ns) { sync_stamp_ = stamp_ns; }
  /// When a frame came [ns]. That of the first one after the SYNC is the best estimate of when the
  /// SYNC was on the wire, if the bus returns no echo of it.
  void on_frame(std::int64_t stamp_ns) {
    if (sync_stamp_ == 0) sync_stamp_ = stamp_ns;
  }
  /// The analogue inputs of one ECU have arrived.
  void add_analog(const EcuLink& link, int ecu, double now, Findings& findings);
  /// Ends the sample: later answers are ignored. If no ECU has answered, there is no new sample.
  /// @param links one for each ECU   @param supervisor its faults override the states that ECUs
  /// report
  void close(const std::vector<EcuLink>& links, const ecu::Supervisor& supervisor, double now);

  /// The last finished sample; before the first one, muscles without measurement.
  const Sample& last() const { return finished_; }
  /// @return false if there is no new one
  bool take(Sample& sample);
  bool take(AnalogSample& sample);

 private:
  const Hardware& hardware_;
  std::vector<ecu::MuscleReference> sent_;  ///< with the last SYNC
  Sample sample_, finished_;
  bool open_ = false, ready_ = false;
  std::int64_t sync_stamp_ = 0;  ///< of the last SYNC; 0: not known yet
  std::deque<AnalogSample> analogs_;
  std::vector<Slope> joint_slopes_;
};

}  // namespace driver
}  // namespace anthrob
