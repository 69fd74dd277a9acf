#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_core/parameter_list.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_sim/replay/replay.h"
#include "options/options.h"

namespace anthrob {
namespace discovery {

/// The input of discovery: a model, recordings and options.
struct Question {
  std::string model_file;
  std::vector<ModelParameter> nuisances;
  std::vector<Dataset> train, test, repeats;
  std::vector<std::string> effects;  ///< ids to consider; empty: all
  int max_effects = 3;
  int jobs = 1;
  std::uint64_t seed = 1;
  double step = 0.001;  ///< of the simulation [s]
  /// Input that drives the replays of robots with muscles; nothing: the earliest that was recorded.
  std::optional<ReplayMode> feed = {};
  Options options;
  // For the report only:
  std::string calibration_file;         ///< that lists the nuisances; empty: none
  std::string simulated_robot_file;     ///< of --close-the-loop; empty: the loop stays open
  std::uint64_t model_fingerprint = 0;  ///< resume::model_fingerprint(); 0: unknown
};

/// What an answer cannot know where no ordinary parameters are fitted.
std::vector<std::string> remarks_on_ordinary_parameters(const Question& question);

}  // namespace discovery
}  // namespace anthrob
