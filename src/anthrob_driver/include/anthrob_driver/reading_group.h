#pragma once

#include <cstddef>
#include <vector>

#include "anthrob_driver/sampler.h"

namespace anthrob {
namespace driver {

/// Puts together what the sensors of one kind read at one instant: they hang on several ECUs, whose
/// answers to one SYNC come one after the other.
class ReadingGroup {
 public:
  /// @param sensors how many there are of this kind
  explicit ReadingGroup(std::size_t sensors) : sensors_(sensors) {}

  /// @return the readings of one instant, in the order of the sensors: all of them as soon as the
  ///     last one is in; what there is of an instant that a sensor did not answer, once there is a
  ///     reading of the next; else nothing
  std::vector<AnalogSample> add(const AnalogSample& reading);

 private:
  std::size_t sensors_;
  std::vector<AnalogSample> pending_;
};

}  // namespace driver
}  // namespace anthrob
