#include "anthrob_calib/report/html.h"
#include "conclusion/conclusion.h"
#include "report/discovery_channels.h"
#include "report/discovery_findings.h"
#include "report/discovery_maps.h"
#include "report/discovery_report.h"
#include "report/discovery_sentences.h"
#include "report/discovery_summary.h"
#include "report/number_text.h"

namespace anthrob {
namespace discovery {

namespace {

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Discovery report</title><style>
body{font-family:sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222;line-height:1.45}
h1{margin-bottom:.2em}table{border-collapse:collapse;margin:1em 0}
td,th{border:1px solid #ccc;padding:.25em .6em;text-align:left}th{background:#f2f2f2}
.answer{font-size:1.25em;border-left:.4em solid #1f77b4;padding:.3em 1em;background:#f5f9fd}
.small{color:#555;font-size:.9em}svg{max-width:100%;height:auto}
summary{cursor:pointer;margin:.6em 0}
.where{font-size:.9em}.where td:nth-child(7){min-width:14em}.where td:nth-child(8){min-width:11em}
</style></head><body>
)";

std::string terms(const Answer& answer) {
  return R"(<h2>Terms</h2><ul>
<li>floor: the gap that noise alone leaves in a channel. It comes from repeats of the same commands or,
without any, from how neighbouring values scatter; errors of rounding and of the simulation are in it.
Gaps are given in floors</li>
<li>recalibrated: the given model with its ordinary parameters, those of calibration.yaml, fitted to
the training recordings, and without any effect added</li>
<li>share: the part of a channel in the squared gap of all channels together, each above the noise</li>
<li>significance: by how many standard errors (sigma), over blocks of 2 s, a channel stands above what
a wrong floor may look like</li>
<li>squared gap: the square of a gap, as far as it stands above what noise may look like ()" +
         short_number(least_gap(!answer.effects.empty())) + R"( floors)</li>
<li>probability: how likely this law at this place is the right one, among the laws that were fitted
and none at all; what it leaves lowers it. The rest, up to 1, belongs to rivals and to laws that the
catalogue lacks</li>
<li>nat: the unit of the log score. One nat more: the recordings are 2.7 times as probable</li>
</ul>
)";
}

std::string verdict_text(const Answer& answer) {
  if (answer.verdict == Verdict::kNoMissingEffect) return "no missing effect found";
  if (answer.verdict == Verdict::kUnexplained) return "unexplained gap";
  const std::size_t count = answer.effects.size();
  return std::to_string(count) + (count == 1 ? " missing effect" : " missing effects");
}

std::string recordings(const Answer& answer, const Question& question) {
  std::string list;
  for (const Dataset& r : question.train) list += "<li>training: " + escaped(r.folder) + "</li>";
  for (const Dataset& r : question.test) list += "<li>held out: " + escaped(r.folder) + "</li>";
  for (const Dataset& r : question.repeats) list += "<li>repeat: " + escaped(r.folder) + "</li>";
  for (const std::string& remark : answer.remarks) list += "<li>" + escaped(remark) + "</li>";
  return "<ul>" + list + "</ul>\n";
}

std::string what_remains(const Answer& answer, const Question& question) {
  const std::string cap = cap_remark(answer, question);
  return "<p>" + escaped(answer.remaining.description) + (cap.empty() ? "" : "; " + escaped(cap)) +
         ".</p>\n" + dependences_of_rest(answer);
}

}  // namespace

std::string report_html(const Answer& answer, const Question& question, double runtime) {
  return kHead +
         ("<h1>Discovery: " + verdict_text(answer) + "</h1>\n<p class=\"small\">Model " +
          escaped(question.model_file) + ", seed " + std::to_string(question.seed) + ", " +
          duration_text(runtime) + " of computing</p>\n<p class=\"answer\">" +
          answer_sentences(answer, question) + "</p>\n") +
         next_steps(answer, question) + gap_table(answer) + example_figures(answer) +
         "<h2>What was found</h2>\n" + findings(answer, question) +
         "<h2>Where model and measurements disagree</h2>\n" + where_table(answer) +
         folded("By place and regime: does the gap depend on speed, load, wrap angle or time?",
                regime_map(answer)) +
         folded("Along the chain: which part from command to sensor is wrong?", seam_map(answer)) +
         dependences_of_gaps(answer) + "<h2>What remains</h2>\n" + what_remains(answer, question) +
         "<h2>Held-out gap by channel</h2>\n" + worse_channels(answer) +
         folded("All channels", channel_table(answer)) +
         "<h2>What these recordings can show</h2>\n" + visibility(answer, question) +
         "<h2>Recordings</h2>" + recordings(answer, question) + terms(answer) + "</body></html>\n";
}

}  // namespace discovery
}  // namespace anthrob
