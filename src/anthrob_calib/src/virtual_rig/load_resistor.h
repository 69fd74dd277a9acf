#pragma once

#include <cstdint>
#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace virtual_rig {

/// The protocol of section 7.3.2, and the deviations of a real rig from its drawing.
struct EcuLoadOptions {
  std::uint64_t seed = 1;
  int specimen = 1;  ///< the first ECU has the known resistance, others are of the same batch
  double load_resistance = 0.33;                  ///< R_L as printed on it [ohm]
  double series_resistance = 0.12;                ///< R_ECU [ohm]
  double max_current = 16.0, current_step = 2.0;  ///< [A]
  double level = 0.05;                            ///< each level of the reference lasts [s]

  double batch_sigma = 0.03;      ///< relative, of R_ECU
  double resistor_sigma = 0.025;  ///< relative, of R_L: 5 % tolerance
  double voltage_gain_sigma = 0.005, voltage_offset_sigma = 0.02;  ///< of the oscilloscope [1, V]
  double current_gain_sigma = 0.01, current_offset_sigma = 0.05;   ///< of the current probe [1, A]
  double voltage_noise = 0.3, current_noise = 0.2;    ///< ripple and noise of a sample [V, A]
  double voltage_count = 0.16, current_count = 0.16;  ///< eight bits [V, A]
};

/// Simulates one recording: a staircase of reference voltages through zero.
Dataset load_ecu(const std::string& rig, const EcuLoadOptions& options);

}  // namespace virtual_rig
}  // namespace anthrob
