#include "anthrob_calib/calibration/extended_model.h"
#include "anthrob_calib/discovery/report.h"
#include "anthrob_sim/effects/catalogue.h"

namespace anthrob {
namespace discovery {

std::string model_text(const Answer& answer, const Evaluator& evaluator, const Question& question,
                       const std::string& folder) {
  std::string comment = "Written by anthrob_discover, seed " + std::to_string(question.seed) +
                        ".\nVerdict: " + answer.verdict + ".\n";
  for (const FoundEffect& effect : answer.effects) {
    comment += "Found: " + effect.id + " at " + effect.place + ", probability " +
               short_number(effect.probability) + ", " + short_number(effect.evidence) +
               " nat on held-out data";
    for (const FoundParameter& p : effect.parameters) {
      comment += ", " + p.name + " " + short_number(p.value) + " [" + short_number(p.low) + ", " +
                 short_number(p.high) + "] " + p.unit;
    }
    comment += ".\n";
  }
  comment += "Held-out gap in units of the floor: " + short_number(answer.test.before) +
             " as given, " + short_number(answer.test.recalibrated) + " recalibrated, " +
             short_number(answer.test.after) + " with what was found.\nLearned from:";
  for (const Dataset& recording : question.train) comment += " " + recording.folder;
  comment += "\nJudged by:";
  for (const Dataset& recording : question.test) comment += " " + recording.folder;

  std::string text = calibration::extended_model_text(
      ConfigNode::load(question.model_file), question.model_file,
      overrides_of(evaluator.nuisances(), answer.extended.nuisances), folder, comment);
  // Lists are replaced by `extends`: those that the model has already are repeated.
  std::vector<EffectInstance> effects = evaluator.model()->effects;
  effects.insert(effects.end(), answer.extended.effects.begin(), answer.extended.effects.end());
  if (!effects.empty()) text += "\n" + effects_yaml(effects);
  return text;
}

}  // namespace discovery
}  // namespace anthrob
