#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/experiment/evaluator.h"
#include "anthrob_calib/discovery/experiment/noise_floor.h"
#include "anthrob_calib/discovery/experiment/regimes.h"
#include "anthrob_calib/discovery/judgement/one_sided_gaps.h"
#include "anthrob_calib/discovery/location/dependence.h"
#include "anthrob_calib/discovery/separation/separating_recording.h"

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
  // For the report only:
  std::string calibration_file;         ///< that lists the nuisances; empty: none
  std::string simulated_robot_file;     ///< of --close-the-loop; empty: the loop stays open
  std::uint64_t model_fingerprint = 0;  ///< resume::model_fingerprint(); 0: unknown
  /// Called with the name of each stage as it begins; returns false to stop.
  std::function<bool(const std::string&)> progress;
  std::function<void(const std::string&)> comment;  ///< a line on what was found so far
};

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

struct Rival {
  std::string id, name, place;
  double probability = 0.0;
  double evidence = 0.0;  ///< gain in held-out log score [nat]
};

/// An effect that was named: it is in the extended model.
struct FoundEffect {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< the channel whose gap it reduces most, "<place>/<channel>"
  double left = 0.0;     ///< share of the squared gap in that channel that is left
  std::vector<FoundParameter> parameters;
  std::string at_limit;  ///< a shape parameter at the end of its range; empty: none
  std::string spoils;    ///< the held-out channel that it makes worst, clearly; empty: none
  double spoilt = 0.0;   ///< what it adds to squared gaps of such channels, as a share of what it
                         ///< takes from those of others
  std::vector<Rival> rivals;
  std::string separating_experiment;         ///< how to tell it from the first rival, in words
  SeparatingRecording separating_recording;  ///< for the recorder; empty where it cannot do it
};

/// One law that can replace two named effects.
struct Alternative {
  std::string id, name, place;
  std::size_t instead_of[2] = {0, 0};  ///< indices of the effects
  double probability = 0.0;            ///< given that either this law or those two are right
  double evidence = 0.0;               ///< held-out log score minus that of the two [nat]
  std::string separating_experiment;   ///< how to tell it from the first of them, in words
};

/// The last candidate that was not named, and why it was not.
struct Refused {
  std::string id, place;  ///< empty: the search did not end by refusing one
  double probability = 0.0, evidence = 0.0;
  std::string lack;
};

/// A law that met the criteria, but leaves so much of the gap, ends so near the limit of its shape,
/// or makes a channel so much worse that it is unlikely to be right. It is reported, but not added
/// to the model.
struct Improbable {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< this and the next four: as in FoundEffect
  double left = 0.0;
  std::string at_limit, spoils;
  double spoilt = 0.0;
};

/// Root mean squares in standard deviations of the floor.
struct Gap {
  double before = 0.0, recalibrated = 0.0, after = 0.0, floor = 0.0;
};

/// Where model and data disagree.
struct Place {
  std::string channel, place, subsystem, regime, unit;
  double rmse = 0.0, noise_floor = 0.0;  ///< [unit]
  double share = 0.0;                    ///< of the squared gap
  /// By how many standard errors it exceeds 1.4 floors (what a wrong noise estimate may look like),
  /// or 1.15 floors where an effect was named. NaN: too little data.
  double significance = std::numeric_limits<double>::quiet_NaN();
};

/// Gaps of a channel when the simulation is fed with measured values at one point (seam) of the
/// chain from command to sensor [standard deviations]. A gap that disappears arises before the
/// seam, a gap that stays arises behind it.
struct SeamGap {
  std::string place, channel;
  bool of_joint = false;    ///< place is a joint, else a muscle
  double commands = -1.0;   ///< the whole chain replayed from its commands
  double voltages = -1.0;   ///< from measured voltages on: without controllers
  double positions = -1.0;  ///< measured motor positions imposed: without motors
  /// Measured joint positions imposed as well: tendons and springs alone. Only of forces. -1, here
  /// and above: not compared.
  double postures = -1.0;
};

/// One channel of a held-out recording, for a figure.
struct Example {
  std::string channel, unit;
  std::vector<double> t, recalibrated, after;  ///< simulated minus measured
};

/// The size from which on the recordings would show an effect.
struct Visibility {
  std::string id, place, unit;
  double smallest_visible = 0.0;  ///< of its most visible size parameter; infinite: none shows
};

struct Answer {
  std::string verdict;  ///< effects_found | no_missing_effect | unexplained
  std::vector<Place> where;
  std::vector<SeamGap> seams;
  std::vector<RegimeGap> regimes;       ///< of what the recalibrated model leaves
  std::vector<Dependence> dependences;  ///< of what the recalibrated model leaves
  /// Of what the extended model leaves; first what explains most of it.
  std::vector<Dependence> remaining;
  std::vector<Example> examples;
  std::vector<FoundEffect> effects;
  std::vector<Alternative> alternatives;
  std::vector<Improbable> improbable;
  std::vector<std::string> dropped;  ///< named first, but no longer needed beside the others
  Refused refused;
  bool ended_early = false;  ///< the search had as many rounds as `max_effects` allows
  bool ended_full = false;   ///< the search had named `max_effects`, some of which may be dropped
  bool certain =
      false;  ///< what the extended model leaves has a gap that is certain (certain_gap())
  std::vector<OneSidedGap> one_sided;  ///< of what the extended model leaves
  double remaining_share = 0.0;
  std::string remaining_description;
  Gap train, test;
  std::map<std::string, Gap> per_channel;  ///< held out, by "<place>/<channel>"
  /// By how many standard errors what was found makes the squared gap of a held-out channel larger;
  /// of channels that are measured in three blocks or more.
  std::map<std::string, double> growth;
  std::vector<Visibility> visible, not_visible;
  std::vector<std::vector<Visibility>> alike;  ///< groups that these data cannot tell apart
  Scales scales;
  Variant given, recalibrated, extended;
  std::vector<std::string> remarks;  ///< what is odd about the recordings, for people
  std::vector<std::string> asked;    ///< separating recordings of the robot (closed_loop.h)
};

/// Runs the whole search of docs/discovery_method.md: fits the ordinary parameters, adds effects
/// one by one until no further one meets the criteria, then gives intervals and a verdict.
/// @throws BadInput for recordings that cannot answer; Interrupted
Answer discover(const Evaluator& evaluator, const Question& question);

}  // namespace discovery
}  // namespace anthrob
