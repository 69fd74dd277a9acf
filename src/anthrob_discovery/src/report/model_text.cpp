#include "report/model_text.h"

#include "anthrob_calib/calibration/extended_model.h"
#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_sim/effects/catalogue.h"
#include "report/number_text.h"

namespace anthrob {
namespace discovery {

namespace {

/// The model's own effects, with the sizes that were corrected; those are taken out of `numbers`.
/// Paths count in the order of the file, a built model has another.
std::vector<EffectInstance> corrected_effects(const RobotModel& robot, const ConfigNode& file,
                                              std::map<std::string, double>& numbers) {
  std::vector<EffectInstance> effects = robot.effects;
  if (!file.has("effects")) return effects;
  const auto entries = file.at("effects").items();
  for (std::size_t e = 0; e < entries.size(); ++e) {
    for (EffectInstance& effect : effects) {
      if (effect.id != entries[e].text("id") || effect.place != entries[e].text("place")) continue;
      for (auto& [name, value] : effect.parameters) {
        const auto moved = numbers.find("effects." + std::to_string(e) + "." + name);
        if (moved == numbers.end()) continue;
        value = moved->second;
        numbers.erase(moved);
      }
    }
  }
  return effects;
}

/// " FOLDER (fingerprint 0123456789abcdef)" of each.
std::string names_of(const std::vector<Dataset>& recordings) {
  std::string text;
  for (const Dataset& recording : recordings) {
    text += " " + recording.folder + " (fingerprint " +
            resume::fingerprint_text(resume::content_fingerprint(recording)) + ")";
  }
  return text;
}

/// What was asked: recordings, ordinary parameters and options.
std::string question_text(const Question& question) {
  std::string text = "Training recordings:" + names_of(question.train);
  text += "\nHeld-out recordings:" + names_of(question.test);
  if (!question.repeats.empty()) {
    text += "\nRepeats, for the noise floor:" + names_of(question.repeats);
  }
  if (question.model_fingerprint != 0) {
    text += "\nFingerprint of the examined model: " +
            resume::fingerprint_text(question.model_fingerprint) + ".";
  }
  text += "\nOrdinary parameters: " + std::to_string(question.nuisances.size());
  if (!question.calibration_file.empty()) text += ", listed by " + question.calibration_file;
  text += ".\nOptions: --dt " + short_number(question.step) + " --max-effects " +
          std::to_string(question.max_effects);
  for (const std::string& id : question.effects) text += " --effects " + id;
  if (!question.simulated_robot_file.empty()) {
    text += " --close-the-loop " + question.simulated_robot_file;
  }
  return text + ".";
}

}  // namespace

std::string model_text(const Answer& answer, const Evaluator& evaluator, const Question& question,
                       const std::string& folder) {
  std::string comment = "Written by anthrob_discover, seed " + std::to_string(question.seed) +
                        ".\nVerdict: " + verdict_name(answer.verdict) + ".\n";
  for (const FoundEffect& effect : answer.effects) {
    comment += "Found: " + effect.id + " at " + effect.place + ", " +
               probability_text(effect.probability) + ", " + short_number(effect.evidence) +
               " nat of evidence";
    for (const FoundParameter& p : effect.parameters) {
      comment += ", " + p.name + " " + interval_text(p);
    }
    comment += ".\n";
  }
  comment += "Gap to the held-out recordings in units of the noise floor: " +
             short_number(answer.diagnosis.test.before) + " as given, " +
             short_number(answer.diagnosis.test.recalibrated) + " recalibrated, " +
             short_number(answer.diagnosis.test.after) + " with what was found.\n" +
             question_text(question);

  std::map<std::string, double> numbers =
      overrides_of(evaluator.nuisances(), answer.extended.nuisances);
  // Lists are replaced by `extends`: those that the model has already are repeated.
  const ConfigNode file = ConfigNode::load(question.model_file);
  std::vector<EffectInstance> effects = corrected_effects(*evaluator.model(), file, numbers);
  std::string text =
      calibration::extended_model_text(file, question.model_file, numbers, folder, comment);
  effects.insert(effects.end(), answer.extended.effects.begin(), answer.extended.effects.end());
  if (!effects.empty()) text += "\n" + effects_yaml(effects);
  return text;
}

}  // namespace discovery
}  // namespace anthrob
