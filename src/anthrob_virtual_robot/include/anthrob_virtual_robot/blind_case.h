#pragma once

#include <map>
#include <string>
#include <vector>

#include "anthrob_config/config_node.h"
#include "anthrob_config/parameter_list.h"
#include "anthrob_virtual_robot/hidden_law.h"
#include "anthrob_virtual_robot/nuisances.h"
#include "anthrob_virtual_robot/recording.h"

namespace anthrob::virtual_robot {

/// One effect of the catalogue, none, two, something else, or the thesis's case: all muscles wrap
/// around bones and the model believes in straight lines.
enum class CaseKind { kEffect, kNull, kPair, kOutside, kWrapped };

CaseKind case_kind(const std::string& word);
std::string word(CaseKind kind);

/// config/anthrob/virtual_robot.yaml
struct CaseSettings {
  SensorSettings sensors;
  NuisanceRanges nuisances;
  RecordingSettings recording;
  std::vector<ModelParameter> ordinary;  ///< what a calibration may correct of the believed model
  int trains = 2;                        ///< train_0, train_1, ...
  double train = 20.0, test = 20.0, slow_train = 120.0, slow_test = 60.0;  ///< [s]
  double least_change = 3.0, most_change = 10.0;  ///< of the worst channel [sensor errors]

  static CaseSettings load(const std::string& file);
};

/// One robot to be examined: what is wrong with it, and what it is believed to be.
struct BlindCase {
  CaseKind kind = CaseKind::kNull;
  std::uint64_t seed = 0;
  reference::ArmParameters believed;
  reference::ArmParameters built;  ///< believed, with errors of calibration
  std::vector<Hidden> hidden;
  SensorSettings sensors;
  double stated_noise = 1.0;  ///< factor by which the scatter of the repeat tells the noise wrong
  bool slow = false;
  /// What the hidden things change, [sensor errors] by channel, without noise.
  std::map<std::string, double> change;
};

/// Case `number` of a kind: cycles through the laws, each time at another place, and where the law
/// changes as much as is asked for, if it does at one of those that are tried. Sizes follow from
/// runs with and without: this takes some runs of train_0 a place.
BlindCase draw_case(CaseKind kind, std::uint64_t number, std::uint64_t seed,
                    const reference::ArmParameters& believed, const CaseSettings& settings);
/// The same of a given law and place.
BlindCase make_case(const std::vector<std::pair<std::string, std::string>>& laws_and_places,
                    std::uint64_t seed, const reference::ArmParameters& believed,
                    const CaseSettings& settings);

/// Runs train_0, ..., test_0 and repeat_0, and writes them as dataset folders.
void record_case(const BlindCase& blind, const CaseSettings& settings, const std::string& folder);

/// What is hidden, as JSON.
std::string truth_text(const BlindCase& blind);

}  // namespace anthrob::virtual_robot
