#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "anthrob_driver/link/sample.h"
#include "anthrob_ecu/supervisor.h"
#include "link/ecu_link.h"
#include "link/slope.h"

namespace anthrob {
namespace driver {

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
