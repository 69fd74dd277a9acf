#pragma once

#include <string>
#include <vector>

#include "anthrob_control/posture_sequence.h"
#include "settle_detector.h"

namespace anthrob {

/// What to record, and how. A YAML file, see config/anthrob/record_tier1_equilibria.yaml.
struct Protocol {
  enum class Kind {
    kEquilibria,    ///< from the rest posture to every posture, by actuator references
    kTrajectories,  ///< the same, and the way back to rest
    kZeroGravity,   ///< a controller holds the posture, which an operator or go_to has set
  };

  /// One posture to visit.
  struct Target {
    std::string name;               ///< "E3"
    std::vector<double> q;          ///< intended joint positions
    std::vector<double> reference;  ///< one per muscle of the model [rad]
    bool by_references = false;     ///< the file gives references; q is not known
  };

  Kind kind = Kind::kEquilibria;
  bool by_hand = false;         ///< zero gravity: postures are set by an operator
  Target rest;                  ///< where every run starts
  std::vector<Target> targets;  ///< in order
  int repeats = 1;
  SettleOptions settle;
  double hold = 0.5;            ///< time from settled to the sample [s]
  double average = 0.1;         ///< the sample is the mean over the last part of the hold [s]
  double drift_limit = 0.0524;  ///< largest angle from the first rest posture [rad]
  int redo = 1;                 ///< how often a refused run is repeated
  double go_duration = 3.0;     ///< zero gravity: duration of the way to a posture [s]
  std::string text;             ///< of file, postures and references: identifies the session

  /// @throws BadInput with one line
  static Protocol load(const std::string& file, const std::shared_ptr<const RobotModel>& model);
};

/// "equilibria", ...
const char* word(Protocol::Kind kind);

}  // namespace anthrob
