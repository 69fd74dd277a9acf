#pragma once

#include <string>

#include "anthrob_core/config_node.h"
#include "random.h"
#include "readings.h"

namespace anthrob::virtual_robot {

/// One kind of sensor.
struct SensorErrors {
  double noise = 0.0;    ///< standard deviation
  double quantum = 0.0;  ///< one count
  double memory = 0.0;   ///< correlation time of the noise; 0: white [s]

  /// Root mean square error of a reading.
  double sigma() const;
};

struct SensorSettings {
  SensorErrors position, velocity, current, force, elbow, shoulder;

  static SensorSettings load(const ConfigNode& node);
  std::string yaml() const;
};

/// Adds noise, then rounds to counts. One call an ECU period.
class Sensors final {
 public:
  Sensors(const SensorSettings& settings, std::size_t muscles, double period, std::uint64_t seed);
  void measure(Readings* readings);

 private:
  double measured(const SensorErrors& errors, double* drift, double value);

  SensorSettings settings_;
  double period_;
  Random random_;
  std::vector<double> drifts_;  // of coloured noise, one a channel
};

}  // namespace anthrob::virtual_robot
