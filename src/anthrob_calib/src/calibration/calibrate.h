#pragma once

#include "calibration/calibration_config.h"
#include "calibration/calibration_outcome.h"

namespace anthrob {
namespace calibration {

/// Recordings, and the folder or bag from which they were loaded.
struct Recordings {
  std::string from;
  std::vector<Dataset> list;
};

/// All input of a calibration, read and checked.
struct CalibrationInput {
  CalibrationConfig config;
  ConfigNode model;                       ///< with the numbers of `start`
  std::map<std::string, double> started;  ///< numbers taken over from earlier calibrations
  std::vector<MeasuredRun> runs, validation;

  /// @param data, validation recordings; validation may be empty
  /// @param start result.json of earlier calibrations: their numbers go into the model; numbers
  /// that this model lacks are skipped
  /// @throws BadInput with one line
  static CalibrationInput read(CalibrationConfig config, const Recordings& data,
                               const Recordings& validation, const std::vector<std::string>& start);

  Problem problem() const;
  /// Fingerprint of everything that the fitness depends on.
  std::string fingerprint() const;
};

/// Computes the results after the search: simulates all runs in full length with the model before
/// and after, examines identifiability, and simulates with other inputs (DriveErrors).
/// @param thorough false: leaves out identifiability and other inputs
/// @param stop whether to stop; also called while runs are simulated, from several threads at once.
/// What is computed until then is in the outcome, which is `interrupted`.
CalibrationOutcome conclude(const CalibrationInput& input, const Problem& problem,
                            const Journal& journal, const std::string& reason, bool thorough,
                            const Stop& stop);

}  // namespace calibration
}  // namespace anthrob
