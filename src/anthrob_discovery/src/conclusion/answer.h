#pragma once

#include <string>
#include <vector>

#include "detectability/detectability.h"
#include "diagnosis/diagnosis.h"
#include "measurement/measurement.h"
#include "search/search_result.h"
#include "separation/separating_recording.h"

namespace anthrob {
namespace discovery {

enum class Verdict {
  kNoMissingEffect,
  kEffectsFound,
  kUnexplained,  ///< a gap is left that no effect of the catalogue explains
  kCannotTell,   ///< effects would explain it, but no better than noise may (withhold())
};

/// "no_missing_effect", "effects_found", "unexplained", "cannot_tell"
std::string verdict_name(Verdict verdict);

struct FoundParameter {
  std::string name, unit;
  double value = 0.0, low = 0.0, high = 0.0;  ///< 95 % interval
  bool known = false;         ///< not fitted: the catalogue's number, without an interval
  bool undetermined = false;  ///< the recordings exclude no value of its range
  bool low_ends = false, high_ends = false;  ///< the interval ends there because its range does
  /// The value is at the end of its range, and the interval is all of it: the size may lie beyond.
  bool at_bound = false;

  bool has_interval() const { return !known && !undetermined && !at_bound; }
};

/// An effect that is in the extended model.
struct FoundEffect : NamedLaw {
  std::vector<FoundParameter> parameters;
  std::string separating_experiment;         ///< how to tell it from the first rival, in words
  SeparatingRecording separating_recording;  ///< for the recorder; empty where it cannot do it
};

/// What the extended model leaves.
struct Remaining {
  double share = 0.0;                   ///< of the squared gap
  bool certain = false;                 ///< a gap that is certain (certain_gap()) is left
  std::vector<Dependence> dependences;  ///< first what explains most of it
  std::string description;
};

struct Answer {
  Verdict verdict = Verdict::kNoMissingEffect;
  std::vector<FoundEffect> effects;
  Remaining remaining;
  Variant given, recalibrated, extended;
  Scales scales;
  Measurement measurement;
  Detectability detectability;
  SearchRecord search;
  Diagnosis diagnosis;
  std::vector<std::string> remarks;  ///< what is odd about the recordings, for people
  std::vector<std::string> asked;    ///< separating recordings of the robot (closed_loop.h)
};

}  // namespace discovery
}  // namespace anthrob
