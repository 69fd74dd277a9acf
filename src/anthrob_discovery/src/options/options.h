#pragma once

#include <optional>
#include <string>

#include "options/admission.h"
#include "options/conclusion.h"
#include "options/detectability.h"
#include "options/diagnosis.h"
#include "options/experiment.h"
#include "options/fit.h"
#include "options/hypotheses.h"
#include "options/judgement.h"
#include "options/loop.h"
#include "options/measurement.h"
#include "options/search.h"
#include "options/separation.h"

namespace anthrob {
namespace discovery {

/// All numbers by which discovery decides, by the stage that they belong to. They are printed in
/// report.json, and docs/discovery_method.md is made from them.
struct Options {
  AdmissionOptions admission;
  MeasurementOptions measurement;
  ExperimentOptions experiment;
  JudgementOptions judgement;
  FitOptions fit;
  HypothesisOptions hypotheses;
  DetectabilityOptions detectability;
  SearchOptions search;
  DiagnosisOptions diagnosis;
  SeparationOptions separation;
  ConclusionOptions conclusion;
  LoopOptions loop;

  template <typename Self, typename Visitor>
  static void visit(Self& options, Visitor&& visit) {
    visit("admission", options.admission);
    visit("measurement", options.measurement);
    visit("experiment", options.experiment);
    visit("judgement", options.judgement);
    visit("fit", options.fit);
    visit("hypotheses", options.hypotheses);
    visit("detectability", options.detectability);
    visit("search", options.search);
    visit("diagnosis", options.diagnosis);
    visit("separation", options.separation);
    visit("conclusion", options.conclusion);
    visit("loop", options.loop);
  }
};

/// The first option that makes no sense, and what was expected: "fit.guard.price: 0: expected a
/// number above 0 and not above 1"; nothing if all do.
std::optional<std::string> invalid_option(const Options& options);

/// The options with one of them changed.
/// @param assignment "judgement.merit.evidence=5"
/// @throws BadInput if there is no such number
Options with_option(Options options, const std::string& assignment);

}  // namespace discovery
}  // namespace anthrob
