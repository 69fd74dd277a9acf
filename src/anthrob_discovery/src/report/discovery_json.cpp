#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_recording/page.h"
#include "report/discovery_figures.h"
#include "report/discovery_report.h"
#include "report/discovery_summary.h"
#include "report/options_json.h"
#include "report/robot_figure.h"
#include "report/separating_files.h"
#include "separation/separating_experiment.h"

namespace anthrob {
namespace discovery {

namespace {

using Json = nlohmann::ordered_json;

/// Not a number is never written.
Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json number(const std::optional<double>& value) {
  return value ? number(*value) : Json(nullptr);
}

Json gap_json(const Gap& gap) {
  return {{"before", number(gap.before)},
          {"recalibrated", number(gap.recalibrated)},
          {"after", number(gap.after)},
          {"floor", number(gap.floor)}};
}

Json parameters_json(const std::vector<FoundParameter>& parameters) {
  Json json = Json::object();
  for (const FoundParameter& p : parameters) {
    json[p.name] = {
        {"value", number(p.value)}, {"ci95", {number(p.low), number(p.high)}}, {"unit", p.unit}};
    if (p.known) json[p.name]["known"] = true;
    if (p.undetermined) json[p.name]["undetermined"] = true;
    if (p.at_bound) json[p.name]["at_bound"] = true;
    if (p.low_ends) json[p.name]["low_ends"] = true;
    if (p.high_ends) json[p.name]["high_ends"] = true;
  }
  return json;
}

Json effect_json(const FoundEffect& effect) {
  Json rivals = Json::array();
  for (const Rival& rival : effect.rivals) {
    rivals.push_back({{"id", rival.id},
                      {"name", rival.name},
                      {"place", rival.place},
                      {"probability", number(rival.probability)},
                      {"evidence", number(rival.evidence)}});
  }
  Json json{{"id", effect.id},
            {"name", effect.name},
            {"place", effect.place},
            {"parameters", parameters_json(effect.parameters)},
            {"probability", number(effect.probability)},
            {"evidence", number(effect.evidence)},
            {"shows_in", effect.shows_in},
            {"left", number(effect.left)},
            {"rivals", rivals},
            {"separating_experiment", effect.separating_experiment}};
  if (!effect.at_limit.empty()) json["at_limit"] = effect.at_limit;
  if (!effect.spoils.empty()) {
    json["spoils"] = effect.spoils;
    json["spoilt"] = number(effect.spoilt);
  }
  return json;
}

Json alternatives_json(const Answer& answer) {
  Json list = Json::array();
  for (const Alternative& one : answer.search.alternatives) {
    Json instead_of = Json::array();
    for (const std::size_t e : one.instead_of) {
      instead_of.push_back({{"id", answer.effects[e].id},
                            {"place", answer.effects[e].place},
                            {"name", answer.effects[e].name}});
    }
    list.push_back({{"id", one.id},
                    {"name", one.name},
                    {"place", one.place},
                    {"instead_of", instead_of},
                    {"probability", number(one.probability)},
                    {"evidence", number(one.evidence)},
                    {"separating_experiment",
                     separating_experiment(answer.effects[one.instead_of[0]].id, one.id)}});
  }
  return list;
}

/// Names of the recorder's files, and what they are expected to tell.
void add_recording(const FoundEffect& effect, std::size_t index, Json& json) {
  if (effect.separating_recording.targets.empty()) return;
  json["separating_protocol"] = separating_file(index);
  json["separating_nat"] = number(effect.separating_recording.distance());
}

Json where_json(const Answer& answer) {
  Json where = Json::array();
  for (const Place& place : answer.diagnosis.where) {
    where.push_back({{"channel", place.channel},
                     {"place", place.place},
                     {"subsystem", place.subsystem},
                     {"regime", place.regime},
                     {"rmse", number(place.rmse)},
                     {"noise_floor", number(place.noise_floor)},
                     {"share", number(place.share)},
                     {"significance", number(place.significance)},
                     {"unit", place.unit}});
  }
  return where;
}

Json visibilities_json(const std::vector<Visibility>& effects) {
  Json list = Json::array();
  for (const Visibility& effect : effects) {
    list.push_back({{"id", effect.id},
                    {"place", effect.place},
                    {"smallest_visible", number(effect.smallest_visible)},
                    {"unit", effect.unit}});
  }
  return list;
}

Json second_json(const Dependence::Second& second) {
  Json curves = Json::array();
  for (const Dependence::Branch& branch : second.branches) {
    curves.push_back({{"second", branch.second}, {"at", branch.at}, {"curve", branch.mean}});
  }
  return {{"variable", second.variable},
          {"how", second.word},
          {"share", number(second.share)},
          {"curves", curves},
          {"unit", second.unit}};
}

/// @param kind of their figures, "gap"
Json dependences_json(const std::vector<Dependence>& dependences, const std::string& kind,
                      const OutputFiles& figures) {
  Json list = Json::array();
  for (const Dependence& d : dependences) {
    list.push_back({{"channel", d.channel},
                    {"variable", d.variable},
                    {"how", d.word},
                    {"share", number(d.share)},
                    {"constant", number(d.constant)},
                    {"at", d.curve.at},
                    {"curve", d.curve.mean}});
    Json& entry = list.back();
    if (d.second) entry["second"] = second_json(*d.second);
    entry["unit"] = d.unit;
    entry["variable_unit"] = d.variable_unit;
    const std::string figure = "figures/" + kind + "_" + std::to_string(list.size()) + ".svg";
    if (figures.count(figure)) entry["figure"] = figure;
  }
  return list;
}

/// null if empty.
Json file_json(const std::string& file) {
  return file.empty() ? Json(nullptr) : Json(file);
}

/// Tell whether files of the same names are still what was examined.
Json fingerprints_json(const Question& question) {
  const auto contents = [](const std::vector<Dataset>& recordings) {
    Json texts = Json::array();
    for (const Dataset& recording : recordings) {
      texts.push_back(resume::fingerprint_text(resume::content_fingerprint(recording)));
    }
    return texts;
  };
  const bool known = question.model_fingerprint != 0;
  return {
      {"model", known ? Json(resume::fingerprint_text(question.model_fingerprint)) : Json(nullptr)},
      {"train", contents(question.train)},
      {"test", contents(question.test)},
      {"repeat", contents(question.repeats)}};
}

/// What was asked, so that it can be asked again.
Json question_json(const Question& question) {
  const auto folders = [](const std::vector<Dataset>& recordings) {
    Json names = Json::array();
    for (const Dataset& recording : recordings) names.push_back(recording.folder);
    return names;
  };
  return {{"model", question.model_file},
          {"calibration", file_json(question.calibration_file)},
          {"train", folders(question.train)},
          {"test", folders(question.test)},
          {"repeat", folders(question.repeats)},
          {"effects", question.effects},
          {"max_effects", question.max_effects},
          {"dt", number(question.step)},
          {"close_the_loop", file_json(question.simulated_robot_file)},
          {"ordinary_parameters", question.nuisances.size()},
          {"fingerprints", fingerprints_json(question)}};
}

Json improbable_json(const Answer& answer) {
  Json list = Json::array();
  for (const Improbable& law : answer.search.improbable) {
    list.push_back({{"id", law.id},
                    {"place", law.place},
                    {"probability", number(law.probability)},
                    {"evidence", number(law.evidence)},
                    {"shows_in", law.shows_in},
                    {"left", number(law.left)},
                    {"name", law.name}});
    if (!law.at_limit.empty()) list.back()["at_limit"] = law.at_limit;
    if (!law.spoils.empty()) {
      list.back()["spoils"] = law.spoils;
      list.back()["spoilt"] = number(law.spoilt);
    }
  }
  return list;
}

/// How the recordings were taken.
Json measurement_json(const Measurement& measurement) {
  Json list = Json::array();
  for (const MeasurementProperty& property : measurement) {
    list.push_back({{"channel_kind", property.channel_kind},
                    {"place", property.place},
                    {"what", property.what},
                    {"value", number(property.value)},
                    {"ci95", {number(property.ci95[0]), number(property.ci95[1])}},
                    {"unit", property.unit},
                    {"source", property.source}});
    if (!property.law.empty()) list.back()["law"] = property.law;
  }
  return list;
}

Json one_sided_json(const std::vector<OneSidedGap>& gaps) {
  Json list = Json::array();
  for (const OneSidedGap& gap : gaps) {
    list.push_back({{"channel", gap.channel},
                    {"learned", number(gap.learned)},
                    {"held_out", number(gap.held_out)}});
  }
  return list;
}

/// What was not compared is left out.
Json seams_json(const std::vector<SeamGap>& seams, const SeamOptions& options) {
  Json list = Json::array();
  for (const SeamGap& seam : seams) {
    Json entry = {{"place", seam.place}, {"channel", seam.channel}};
    if (seam.commands) entry["commands"] = number(seam.commands);
    if (seam.voltages) entry["voltages"] = number(seam.voltages);
    if (seam.positions) entry["positions"] = number(seam.positions);
    if (seam.postures) entry["postures"] = number(seam.postures);
    if (postures_mislead(seam, options)) entry["postures_mislead"] = true;
    list.push_back(entry);
  }
  return list;
}

Json regimes_json(const std::vector<RegimeGap>& regimes) {
  Json list = Json::array();
  for (const RegimeGap& row : regimes) {
    Json gaps = Json::array();
    for (const std::optional<double>& gap : row.gap) gaps.push_back(number(gap));
    list.push_back({{"place", row.place}, {"by", row.word}, {"gap", gaps}});
  }
  return list;
}

Json gaps_json(const Diagnosis& diagnosis) {
  Json channels = Json::object();
  for (const auto& [name, gap] : diagnosis.per_channel) {
    channels[name] = gap_json(gap);
    const auto growth = diagnosis.growth.find(name);
    if (growth != diagnosis.growth.end()) channels[name]["growth"] = number(growth->second);
  }
  return {{"train", gap_json(diagnosis.train)},
          {"test", gap_json(diagnosis.test)},
          {"per_channel", channels}};
}

const char* search_end_name(SearchEnd end) {
  switch (end) {
    case SearchEnd::kRounds:
      return "rounds";
    case SearchEnd::kFull:
      return "full";
    case SearchEnd::kNoMore:
      break;
  }
  return "no_more";
}

/// Where what was found acts, or else where the largest part of the gap is.
std::vector<std::string> marked_places(const Answer& answer) {
  std::vector<std::string> places;
  for (const FoundEffect& effect : answer.effects) places.push_back(effect.place);
  if (places.empty() && !answer.diagnosis.where.empty()) {
    places.push_back(answer.diagnosis.where.front().place);
  }
  return places;
}

/// Levels by which the page chooses its words.
Json criteria_json(const Answer& answer, const JudgementOptions& options) {
  return {{"real_gap", options.real_gap},
          {"faint_gap", options.faint_gap},
          {"least_gap", least_gap(!answer.effects.empty(), options)},
          {"even_odds", options.trust.even_odds.value},
          {"sure", options.sure}};
}

}  // namespace

std::string report_json(const Answer& answer, const Question& question, double runtime,
                        const OutputFiles& figures) {
  const Options& options = question.options;
  Json report;
  report["verdict"] = verdict_name(answer.verdict);
  report["where"] = where_json(answer);
  report["effects"] = Json::array();
  for (std::size_t i = 0; i < answer.effects.size(); ++i) {
    Json effect = effect_json(answer.effects[i]);
    add_recording(answer.effects[i], i + 1, effect);
    report["effects"].push_back(std::move(effect));
  }
  report["remarks"] = answer.remarks;
  const std::string cap = cap_remark(answer, question);
  if (!cap.empty()) report["remarks"].push_back(cap);
  report["measurement"] = measurement_json(answer.measurement);
  report["alternatives"] = alternatives_json(answer);
  report["improbable"] = improbable_json(answer);
  report["dropped"] = answer.search.dropped;
  if (const auto& refused = answer.search.refused) {
    report["refused"] = {{"id", refused->id},
                         {"place", refused->place},
                         {"probability", number(refused->probability)},
                         {"evidence", number(refused->evidence)},
                         {"lack", refused->lack}};
  }
  if (!answer.asked.empty()) report["asked"] = answer.asked;
  report["remaining"] = {{"share", number(answer.remaining.share)},
                         {"description", answer.remaining.description},
                         {"dependences", dependences_json(telling_dependences_of_rest(
                                                              answer, options.diagnosis.dependence),
                                                          "rest", figures)},
                         {"certain", answer.remaining.certain}};
  report["gap"] = gaps_json(answer.diagnosis);
  report["not_visible"] = visibilities_json(answer.detectability.not_visible);
  report["visible"] = visibilities_json(answer.detectability.visible);
  report["alike"] = Json::array();
  for (const auto& group : answer.detectability.alike)
    report["alike"].push_back(visibilities_json(group));
  report["seams"] = seams_json(answer.diagnosis.seams, options.diagnosis.seams);
  report["regimes"] = regimes_json(answer.diagnosis.regimes);
  report["model"] = "model.yaml";
  report["question"] = question_json(question);
  report["seed"] = question.seed;
  report["runtime_s"] = number(runtime);
  report["search_end"] = search_end_name(answer.search.end);
  report["one_sided"] = one_sided_json(answer.diagnosis.one_sided);
  report["dependences"] = dependences_json(
      telling_dependences_of_gaps(answer, options.diagnosis.dependence), "gap", figures);
  report["criteria"] = criteria_json(answer, options.judgement);
  report["options"] = options_json(options);
  report["figures"] = figures_of(figures);
  return report.dump(2) + "\n";
}

OutputFiles report_files(const Answer& answer, const Question& question, double runtime,
                         const RobotModel* robot) {
  OutputFiles files = discovery_figures(answer, question.options.diagnosis);
  const std::string drawn = robot ? robot_figure(*robot, marked_places(answer)) : "";
  if (!drawn.empty()) files["figures/robot_1.svg"] = drawn;
  files["report.json"] = report_json(answer, question, runtime, files);
  return files;
}

}  // namespace discovery
}  // namespace anthrob
