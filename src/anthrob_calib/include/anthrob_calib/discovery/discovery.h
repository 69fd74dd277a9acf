#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "anthrob_calib/discovery/dependence.h"
#include "anthrob_calib/discovery/evaluator.h"
#include "anthrob_calib/discovery/noise_floor.h"
#include "anthrob_calib/discovery/regimes.h"
#include "anthrob_calib/discovery/separating_recording.h"

namespace anthrob {
namespace discovery {

/// A question to the data: what is this model missing?
struct Question {
  std::string model_file;
  std::vector<ModelParameter> nuisances;
  std::vector<Dataset> train, test, repeats;
  std::vector<std::string> effects;  ///< ids to consider; empty: all
  int max_effects = 3;
  int jobs = 1;
  std::uint64_t seed = 1;
  double step = 0.001;  ///< of the simulation [s]
  /// Called with what is done next; returns false to stop.
  std::function<bool(const std::string&)> progress;
  std::function<void(const std::string&)> comment;  ///< a line on what was found so far
};

struct FoundParameter {
  std::string name, unit;
  double value = 0.0, low = 0.0, high = 0.0;  ///< 95 % interval
  bool known = false;  ///< nothing that was fitted: the catalogue's number, without an interval
};

struct Rival {
  std::string id, place;
  double probability = 0.0;
  double evidence = 0.0;  ///< gain in held-out log score [nat]
};

/// An effect that the data ask for.
struct FoundEffect {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< the channel in which it took away most, "<place>/<channel>"
  double left = 0.0;     ///< of what was to be explained there: share of the squared gap
  std::vector<FoundParameter> parameters;
  std::string at_limit;  ///< a parameter of its shape that ends where the catalogue's range does
  std::vector<Rival> rivals;
  std::string separating_experiment;         ///< from the first rival, in words
  SeparatingRecording separating_recording;  ///< and for the recorder, where it can do it
};

/// One law that says alone what two named effects say together.
struct Alternative {
  std::string id, place;
  std::size_t instead_of[2] = {0, 0};  ///< indices of the effects
  double probability = 0.0;            ///< if it is either this one or those two
  double evidence = 0.0;               ///< log score on held-out data, less that of the two [nat]
  std::string separating_experiment;   ///< from the first of them, in words
};

/// The last candidate that was not named, and why it was not.
struct Refused {
  std::string id, place;  ///< empty: the search did not end by refusing one
  double probability = 0.0, evidence = 0.0;
  std::string lack;
};

/// A law that earned its place, but leaves so much that it is hardly the right one: it does not
/// extend the model.
struct Improbable {
  std::string id, name, place;
  double probability = 0.0, evidence = 0.0;
  std::string shows_in;  ///< as of a FoundEffect, the others too
  double left = 0.0;
  std::string at_limit;
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
  /// Standard errors beyond 1.4 floors, which a wrong estimate of noise may look like, or 1.15
  /// where an effect was named; NaN: too little data to tell.
  double significance = std::numeric_limits<double>::quiet_NaN();
};

/// How large a channel's disagreement is, depending on what is fed with measured values: a gap
/// that stays belongs behind the seam, one that goes belongs before it. [standard deviations]
struct SeamGap {
  std::string place, channel;
  bool of_joint = false;    ///< place is a joint, else a muscle
  double commands = -1.0;   ///< the whole chain replayed from its commands
  double voltages = -1.0;   ///< from measured voltages on: without controllers
  double positions = -1.0;  ///< measured motor positions imposed: without motors
  /// Measured joint positions imposed, too: tendons and springs alone. Of forces; -1: not compared.
  double postures = -1.0;
};

/// One channel of a held-out recording, for a figure.
struct Example {
  std::string channel, unit;
  std::vector<double> t, recalibrated, after;  ///< simulated minus measured
};

/// From which size on these data would show an effect.
struct Visibility {
  std::string id, place, unit;
  double smallest_visible = 0.0;  ///< of its most visible size; infinite if no size is
};

struct Answer {
  std::string verdict;  ///< effects_found | no_missing_effect | unexplained
  std::vector<Place> where;
  std::vector<SeamGap> seams;
  std::vector<RegimeGap> regimes;       ///< of what the recalibrated model leaves
  std::vector<Dependence> dependences;  ///< of what the recalibrated model leaves
  std::vector<Dependence> remaining;    ///< of what the extended model leaves
  std::vector<Example> examples;
  std::vector<FoundEffect> effects;
  std::vector<Alternative> alternatives;
  std::vector<Improbable> improbable;
  std::vector<std::string> dropped;  ///< were named first, and are not needed beside the others
  Refused refused;
  double remaining_share = 0.0;
  std::string remaining_description;
  Gap train, test;
  std::map<std::string, Gap> per_channel;  ///< held out, by "<place>/<channel>"
  std::vector<Visibility> visible, not_visible;
  std::vector<std::vector<Visibility>> alike;  ///< groups that these data cannot tell apart
  Scales scales;
  Variant given, recalibrated, extended;
  std::vector<std::string> remarks;  ///< what is odd about the recordings, for people
  std::vector<std::string> asked;    ///< what the robot was recorded for in between (closed_loop.h)
};

/// Locates, names, adds and judges, until nothing earns its place.
/// @throws BadInput for recordings that cannot answer; Interrupted
Answer discover(const Evaluator& evaluator, const Question& question);

}  // namespace discovery
}  // namespace anthrob
