#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace virtual_rig {

/// A rubber ring of known parameters: an entry of rings.yaml.
struct RingTruth {
  std::string name;                      ///< "10x5"
  double rest_length, section_diameter;  ///< [m]
  /// E_0, E_1, tau_1 or E_0, E_1, tau_1, E_2, tau_2 [Pa, s]; their deviations in the thesis.
  std::vector<double> parameters, sigma;

  /// @param rig folder config/rig_oring_stretcher   @param arms 1: Zener, 2: Wiechert
  /// @throws BadInput if there is no such ring
  static RingTruth load(const std::string& rig, const std::string& name, int arms);
};

/// Names of all rings of rings.yaml.
std::vector<std::string> ring_names(const std::string& rig);

/// The protocol of section 7.2.3, and the deviations of a real rig from its drawing.
struct StretchOptions {
  std::uint64_t seed = 1;
  int specimen = 1;  ///< the first has the known parameters, others are of the same batch
  int run = 1;
  int levels = 16;  ///< relaxation tests at equally spaced strains
  double max_strain = 2.0;
  double hold = 10.0, recover = 20.0;  ///< [s]

  double batch_sigma = 0.02;        ///< relative, of the moduli of rings of one type
  double radius_sigma = 0.002;      ///< relative, of the spindle with its line
  double calliper_sigma = 5e-5;     ///< of the inner length at the start [m]
  double force_offset_sigma = 0.5;  ///< [N]
};

/// Simulates one recording run: motor, controller, encoder and force sensor are those of the model
/// files, the ring is `truth`. Deviations belong to the seed and the specimen, noise also to the
/// run.
Dataset stretch_ring(const std::string& rig, const RingTruth& truth, const StretchOptions& options);

}  // namespace virtual_rig
}  // namespace anthrob
