#pragma once

#include "twin/feed.h"

namespace anthrob {
namespace twin {

/// Every number that decides in the twins; the defaults are of a robot that is measured 100 to 1000
/// times a second.
struct TwinOptions {
  // --- what is measured
  double largest_gap = 0.25;  ///< [s] between two measurements beyond which the robot was lost; the
                              ///< robot's own watch gives up commands after 0.5 s
  double patience = 1.0;   ///< [s] for a topic that is behind the others, or has not come yet; of a
                           ///< simulator that runs ten times as fast it is 0.1 s of ours
  double backwards = 0.5;  ///< [s] by which a stamp lies behind if time was set back; less is late
  int late_in_row = 20;    ///< late ones one after the other: time was set back by less than that
  double jump_factor = 2.0;  ///< a motion is a jump if it is so often faster than measured speeds
  double least_jump = 0.05;  ///< [rad, m] that noise and counts do not make
  double fastest = 30.0;     ///< [rad/s, m/s] where no speed is measured; three no-load speeds
  double history = 5.0;      ///< [s] of measurements that may wait to be simulated, at 1 kHz

  // --- starting anew
  double stand = 5.0;   ///< [s] simulated at the measured posture first; O-rings relax in 1.5 s
  double settle = 2.0;  ///< [s] measured time that does not count then: motions that were under way
  double retry = 1.0;   ///< [s] after a numerical failure
  double pull = 0.2;    ///< [s] in which the motors fed with voltages come back to where they were
                        ///< measured. Without it they integrate noise, and what voltages do between
                        ///< two messages: 15 mV of a 200 Hz bus that jump with each reference
  double average = 0.01;  ///< [s] on both sides, of measured speeds of motors, for the same reason
  double smooth = 0.1;    ///< [s] in which imposed positions follow the measured ones; within, they
                          ///< follow measured speeds: counts would turn the tendons' friction about

  // --- the gap. Floors at least, of sensors that have neither noise nor counts: what happens
  // between two measurements is not known, and makes up to half of that at 500 Hz.
  double least_force = 0.02;  ///< [N, Nm]
  double least_position =
      1e-3;  ///< [rad] of a motor: 0.06 degrees, a reference that moved meanwhile
  double least_current = 0.005;  ///< [A]
  double least_angle = 5e-4;     ///< [rad] of a joint, 0.03 degrees: counts of motors move it
  double least_distance = 2e-5;  ///< [m] of a joint
  double bin = 0.02;             ///< [s] over which differences are averaged; as in discovery
  int bins_in_block = 50;        ///< gaps are told after each, and windows are whole ones
  int noise_bins = 3000;         ///< that the floor is learned from, a minute
  int least_noise = 40;          ///< of them before there is a floor
  int raw_values = 500;          ///< from which a sensor's counts are found
  double half_told = 0.5;        ///< share of a window that must have been compared

  // --- the warning
  double warn = 4.0;  ///< [floors] over the second window; a right model with coarse counts has
                      ///< shown 3.2 in 15 minutes, as friction follows the noise of imposed speeds
};

/// [blocks] one, ten and sixty seconds.
constexpr int kWindowCount = 3;
constexpr int kWindowBlocks[kWindowCount] = {1, 10, 60};
constexpr int kWarningWindow = 1;  ///< of them

}  // namespace twin
}  // namespace anthrob
