#pragma once

#include <map>
#include <string>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_core/parameter_list.h"
#include "hidden_law.h"
#include "nuisances.h"
#include "recording.h"

namespace anthrob::virtual_robot {

/// What is hidden: one effect of the catalogue, nothing, two effects, one that the catalogue lacks,
/// or the case of the thesis: all muscles wrap around bones, and the model has straight lines.
enum class CaseKind { kEffect, kNull, kPair, kOutside, kWrapped };

CaseKind case_kind(const std::string& word);
std::string word(CaseKind kind);

/// config/anthrob/virtual_robot.yaml
struct CaseSettings {
  SensorSettings sensors;
  NuisanceRanges nuisances;
  RecordingSettings recording;
  std::vector<ModelParameter> ordinary;  ///< what a calibration may correct in the believed model
  int trains = 2;                        ///< train_0, train_1, ...
  double train = 20.0, test = 20.0, slow_train = 120.0, slow_test = 60.0;  ///< [s]
  /// Wanted change of the worst channel [sensor errors].
  double least_change = 3.0, most_change = 10.0;

  static CaseSettings load(const std::string& file);
};

/// One case of a blind test: the robot with its hidden effects, and the model that it is believed
/// to be.
struct BlindCase {
  CaseKind kind = CaseKind::kNull;
  std::uint64_t seed = 0;
  reference::ArmParameters believed;
  reference::ArmParameters built;  ///< believed, with errors of calibration
  std::vector<Hidden> hidden;
  SensorSettings sensors;
  double stated_noise = 1.0;  ///< factor by which the repeat's scatter misstates the noise
  bool slow = false;
  /// Change by the hidden effects without noise, by channel [sensor errors].
  std::map<std::string, double> change;
};

/// Draws case `number` of a kind. Successive numbers cycle through the laws; each cycle uses other
/// places. Several places are tried until the law changes as much as the settings want. The sizes
/// follow from simulations with and without the effect, some runs of train_0 for each place.
BlindCase draw_case(CaseKind kind, std::uint64_t number, std::uint64_t seed,
                    const reference::ArmParameters& believed, const CaseSettings& settings);
/// The same for given laws and places.
/// @throws std::invalid_argument if a law cannot be at that place
BlindCase make_case(const std::vector<std::pair<std::string, std::string>>& laws_and_places,
                    std::uint64_t seed, const reference::ArmParameters& believed,
                    const CaseSettings& settings);

/// Simulates train_0, ..., test_0 and repeat_0, and writes them as dataset folders.
void record_case(const BlindCase& blind, const CaseSettings& settings, const std::string& folder);

/// The truth: what is hidden, as JSON.
std::string truth_text(const BlindCase& blind);

}  // namespace anthrob::virtual_robot
