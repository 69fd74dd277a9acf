#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_driver/hardware.h"
#include "anthrob_driver/link/sample.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

/// Limits how far the first POSITION reference of a muscle may be from its position. A muscle that
/// follows POSITION references already may be given any.
class FirstStep {
 public:
  /// @param hardware must outlive this object   @param limit [rad]; 0: no limit
  FirstStep(const Hardware& hardware, double limit) : hardware_(hardware), limit_(limit) {}

  /// To be asked about a command that came while enabled and not homing.
  /// @param names, modes, references the command, not checked yet
  /// @param followed what the muscles follow at present, one for each
  /// @param last measurement of the muscles; without one, the command is forbidden
  /// @return why the limit forbids the command, if it does
  std::optional<std::string> too_far(const std::vector<std::string>& names,
                                     const std::vector<std::uint8_t>& modes,
                                     const std::vector<double>& references,
                                     const std::vector<ecu::MuscleReference>& followed,
                                     const Sample& last) const;

 private:
  const Hardware& hardware_;
  double limit_;
};

}  // namespace driver
}  // namespace anthrob
