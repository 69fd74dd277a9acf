#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_ecu/parameters.h"
#include "anthrob_ecu/protocol.h"
#include "anthrob_ecu/supervisor.h"

namespace anthrob {
namespace driver {

/// A sensor whose value is gain * (count - offset): potentiometers, strain gauges.
struct LinearSensor {
  double gain = 1.0;    ///< [unit/count], not 0
  double offset = 0.0;  ///< [counts] at value 0

  /// Counts outside are at a converter's end stops: they come from a broken cable, not from a
  /// value.
  static bool measures(int count) {
    return count >= ecu::kLowestCount && count <= ecu::kHighestCount;
  }
  double value(double count) const { return gain * (count - offset); }
  /// The 12-bit count a converter gives for a value.
  int count(double value) const {
    return static_cast<int>(std::lround(std::clamp(offset + value / gain, 0.0, 4095.0)));
  }
};

/// A force-sensitive resistor at the top of a voltage divider. Its conductance grows linearly with
/// the force, so force = gain * u / (1 - u) with u = count / 4096.
struct ForceSensitiveResistor {
  double gain = 1.0;        ///< [N] force at half the supply voltage, > 0
  double threshold = 20.0;  ///< [counts] below this the pad is not touched

  /// NaN at the converter's upper end stop, which means a short circuit. A cut cable cannot be
  /// distinguished from a pad that is not touched.
  double force(double count) const {
    if (count < threshold) return 0.0;
    if (count > ecu::kHighestCount) return std::numeric_limits<double>::quiet_NaN();
    const double u = count / 4096.0;
    return gain * u / (1.0 - u);
  }
  int count(double force) const {
    const double u = force / (gain + std::max(force, 0.0));
    return static_cast<int>(std::lround(std::min(4096.0 * u, 4095.0)));
  }
};

/// Motor, gear and spindle of a muscle, as its model describes them.
struct Winch {
  double back_emf = 0.0;  ///< k [Vs/rad, Nm/A] at the gear output; 0: not known
  double inertia = 0.0;   ///< J of the rotor [kg m^2] at the gear output
  double radius = 0.0;    ///< r of the spindle [m]; 0: not known
};

/// One muscle as it is wired.
struct MuscleHardware {
  std::string name;
  int ecu = 0;      ///< index in Hardware::ecus
  int channel = 0;  ///< 0 or 1 on that ECU
  ecu::ParameterSet parameters;
  ecu::MuscleChannel limits;  ///< of commands
  LinearSensor force, current;
  double encoder_scale = 0.0;  ///< [rad/count]
  double home_position = 0.0;  ///< [rad] its position after home, in the pretensioned posture
  double resistance = 0.0;     ///< [ohm] of the model's motor and power stage; 0: not known
  Winch winch;
  /// What WindingTemperatureModel has to know [A, s]; 0: not known
  double nominal_current = 0.0, thermal_time_constant = 0.0;
};

struct EcuHardware {
  std::string name;
  int node = 0;
  std::vector<int> muscles;  ///< indices in Hardware::muscles, by channel
  int analogs = 0;           ///< analogue inputs in use

  std::uint16_t configuration = 0;  ///< checksum of all parameters
};

/// An analogue input. Without `ecu` it is not read: its ECU has no muscles, and so is not used.
struct JointSensor {
  std::string joint;
  std::optional<int> ecu;
  int input = 0;
  LinearSensor sensor;  ///< [rad/count]
};
struct TouchSensor {
  std::string name;
  std::optional<int> ecu;  ///< as a JointSensor's
  int input = 0;
  ForceSensitiveResistor sensor;
};

/// How `home` brings all tendons to a common tension and recognises a broken or slipped one.
struct HomeRoutine {
  double pretension = 5.0;    ///< [N]
  double tolerance = 1.0;     ///< [N] for "reached"
  double force_limit = 20.0;  ///< [N] more than this on any tendon aborts
  double wind_speed = 1.0;    ///< [rad/s] until a tendon grips
  double travel_limit = 6.0;  ///< [rad] wound in without reaching it: broken or slack
  double slip_drop = 0.5;     ///< [1] share of the pretension lost after it was held: slipped
  double settle_time = 1.0;   ///< [s] all within tolerance
  double time_limit = 15.0;   ///< [s]
};

/// When the tendon of a muscle with force sensor counts as broken in motion, see TendonWatch.
struct TendonLimits {
  double loaded = 20.0;  ///< [N] sudden loss of at least this load is an alarm; 0: no such alarm
  double slack = 2.5;    ///< [N] less than this is no force
  double travel = 12.0;  ///< [rad] most winding in without force though one is commanded; 0: any
};

/// A robot as it is wired, from hardware.yaml, its model file and its calibration file.
struct Hardware {
  std::string file;
  std::vector<MuscleHardware> muscles;  ///< in the order of the model file, hand last
  std::vector<EcuHardware> ecus;
  std::vector<int> idle_nodes;  ///< of ECUs that may be on the bus but are not used
  std::vector<JointSensor> joints;
  std::vector<TouchSensor> touch;
  HomeRoutine home;
  TendonLimits tendons;

  std::vector<ecu::MuscleChannel> channels() const;
};

/// Muscles, gains and command limits come from the model file that hardware.yaml names, the rest
/// from hardware.yaml and the calibration file it names.
/// @param hand whether to load the hand's muscles and touch sensors
/// @param model model file to use instead of the one that hardware.yaml names
/// @throws BadInput with one line: file, line, key, value, what was expected
Hardware load_hardware(const std::string& file, bool hand,
                       const std::optional<std::string>& model = std::nullopt);

/// Recomputes the checksum; to be called after parameters of a muscle of this ECU have changed.
void update_configuration(Hardware& hardware, int ecu);

/// Whether hardware.yaml describes a hand at all.
/// @throws BadInput if it cannot be read
bool has_hand(const std::string& file);

/// The first difference between `a` and `b` in what ECUs hold or in the limits of commands, as
/// muscle and what differs ("NAME: missing" if `b` lacks it).
std::optional<std::string> difference(const Hardware& a, const Hardware& b);

}  // namespace driver
}  // namespace anthrob
