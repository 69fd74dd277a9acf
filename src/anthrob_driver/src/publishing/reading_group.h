#pragma once

#include <cstddef>
#include <vector>

#include "anthrob_driver/link/sample.h"

namespace anthrob {
namespace driver {

/// Groups the readings of all sensors of one kind at one instant. The sensors are connected to
/// several ECUs, whose answers to one SYNC arrive one after the other.
class ReadingGroup {
 public:
  /// @param sensors how many there are of this kind
  explicit ReadingGroup(std::size_t sensors) : sensors_(sensors) {}

  /// @return the readings of one instant in the order of the sensors, as soon as all have arrived;
  /// if a sensor did not answer, the others' with the first reading of the next instant; otherwise
  /// nothing
  std::vector<AnalogSample> add(const AnalogSample& reading);

 private:
  std::size_t sensors_;
  std::vector<AnalogSample> pending_;
};

}  // namespace driver
}  // namespace anthrob
