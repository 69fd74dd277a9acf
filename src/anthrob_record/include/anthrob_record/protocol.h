#pragma once

#include <string>
#include <vector>

#include "anthrob_control/posture_sequence.h"
#include "anthrob_record/settle_detector.h"

namespace anthrob {

/// What to record, and how. A YAML file, see config/anthrob/record_tier1_equilibria.yaml.
struct Protocol {
  enum class Kind {
    kEquilibria,    ///< from the rest posture to every posture, by actuator references
    kTrajectories,  ///< the same, and the way back
    kZeroGravity,   ///< a controller holds the posture; set by hand or by going there
  };

  /// One posture to visit.
  struct Target {
    std::string name;               ///< "E3"
    std::vector<double> q;          ///< what it is meant to be
    std::vector<double> reference;  ///< [rad] by muscle, index as in the model
    bool by_references = false;     ///< as they are in the file; q is not known
  };

  Kind kind = Kind::kEquilibria;
  bool by_hand = false;         ///< zero gravity: postures are set by an operator
  Target rest;                  ///< where every run starts
  std::vector<Target> targets;  ///< in order
  int repeats = 1;
  SettleOptions settle;
  double hold = 0.5;            ///< from settled to the sample [s]
  double average = 0.1;         ///< the sample is the mean over so much of the hold's end [s]
  double drift_limit = 0.0524;  ///< of the rest posture against the first one [rad]
  int redo = 1;                 ///< how often a run is done again if the rest posture has drifted
  double go_duration = 3.0;     ///< zero gravity: how long to go to a posture [s]
  std::string text;             ///< of file, postures and references, to know it again

  /// @throws BadInput with one line
  static Protocol load(const std::string& file, const std::shared_ptr<const RobotModel>& model);
};

/// "equilibria", ...
const char* word(Protocol::Kind kind);

}  // namespace anthrob
