#include "health/health_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "anthrob_core/text.h"
#include "anthrob_recording/page.h"
#include "anthrob_recording/svg_figure.h"

namespace anthrob {
namespace health {

namespace {

using nlohmann::ordered_json;

ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json figure_json(Quantity quantity, const History::Series& series,
                         const HealthOptions& options) {
  const Figure& last = series.back().figure;
  ordered_json out = {{"quantity", name_of(quantity)},
                      {"unit", unit_of(quantity)},
                      {"value", last.value},
                      {"ci95", {last.low, last.high}},
                      {"tests", series.size()}};
  const auto trend = trend_of(quantity, series, options);
  if (!trend) return out;
  out["normal"] = trend->normal;
  out["change"] = trend->change();
  out["visible"] = finite_or_null(trend->visible);
  out["limit"] = trend->limit;
  out["per_day"] = trend->per_day;
  out["certain"] = trend->is_certain;
  out["days"] = trend->days ? finite_or_null(*trend->days) : ordered_json(nullptr);
  return out;
}

/// All figures of a tendon over the days, as shares of what would be too much.
std::string chart_of(const std::string& muscle, const History& history,
                     const HealthOptions& options) {
  SvgFigure figure(muscle);
  auto& panel = figure.add_panel("days before the last test", "change / limit");
  for (int k = 0; k < kQuantities; ++k) {
    const auto quantity = static_cast<Quantity>(k);
    const auto& series = history.series(muscle, quantity);
    const auto trend = trend_of(quantity, series, options);
    if (!trend) continue;
    SvgFigure::Line line;
    line.label = name_of(quantity);
    for (const Test& test : series) {
      line.x.push_back(test.day - history.last_day());
      line.y.push_back((test.figure.value - trend->normal) / trend->limit);
    }
    panel.lines.push_back(std::move(line));
  }
  return panel.lines.empty() ? std::string() : figure.render();
}

std::vector<std::string> with_findings_first(std::vector<std::string> muscles,
                                             const std::vector<Finding>& found) {
  std::stable_partition(muscles.begin(), muscles.end(), [&](const std::string& muscle) {
    return std::any_of(found.begin(), found.end(),
                       [&](const Finding& finding) { return finding.muscle == muscle; });
  });
  return muscles;
}

std::string headline_of(const History& history, const std::vector<Finding>& found,
                        const HealthOptions& options) {
  const std::size_t count = history.muscles().size();
  const std::string tendons = std::to_string(count) + (count == 1 ? " tendon" : " tendons");
  std::size_t tests = 0;
  for (const std::string& muscle : history.muscles()) {
    tests = std::max(tests, history.series(muscle, Quantity::kResistance).size());
    tests = std::max(tests, history.series(muscle, Quantity::kStiffness).size());
  }
  if (tests < static_cast<std::size_t>(options.fewest_tests)) {
    return tendons + ": test " + std::to_string(tests) + " of the " +
           std::to_string(options.fewest_tests) + " before which nothing is called a change";
  }
  if (found.empty()) return tendons + ": nothing has changed";
  return tendons + ": " + std::to_string(found.size()) +
         (found.size() == 1 ? " has changed" : " changes") + ", first " + found.front().muscle;
}

}  // namespace

HealthReport report_health(const std::string& robot, const History& history,
                           const std::vector<TendonFigures>& latest, const HealthOptions& options) {
  HealthReport report;
  std::vector<Finding> found = findings(history, options);
  std::stable_sort(found.begin(), found.end(),
                   [](const Finding& a, const Finding& b) { return a.days < b.days; });
  report.headline = headline_of(history, found, options);
  ordered_json out = {{"robot", robot},
                      {"time", time_of_day(history.last_day())},
                      {"headline", report.headline},
                      {"findings", ordered_json::array()},
                      {"tendons", ordered_json::array()}};
  for (const Finding& finding : found) {
    ordered_json quantities = ordered_json::array();
    for (const Quantity quantity : finding.quantities) quantities.push_back(name_of(quantity));
    out["findings"].push_back({{"muscle", finding.muscle},
                               {"cause", finding.cause},
                               {"evidence", finding.evidence},
                               {"quantities", quantities},
                               {"days", finite_or_null(finding.days)},
                               {"text", finding.text()}});
    report.lines.push_back(finding.text());
  }
  for (const std::string& muscle : with_findings_first(history.muscles(), found)) {
    ordered_json tendon = {{"muscle", muscle}, {"figures", ordered_json::array()}};
    for (int k = 0; k < kQuantities; ++k) {
      const auto quantity = static_cast<Quantity>(k);
      const auto& series = history.series(muscle, quantity);
      if (!series.empty()) tendon["figures"].push_back(figure_json(quantity, series, options));
    }
    tendon["remarks"] = ordered_json::array();
    for (const TendonFigures& own : latest) {
      if (own.muscle == muscle) tendon["remarks"] = own.remarks;
    }
    out["tendons"].push_back(std::move(tendon));
    const std::string chart = chart_of(muscle, history, options);
    if (!chart.empty()) report.files["figures/" + muscle + ".svg"] = chart;
  }
  out["figures"] = figures_of(report.files);
  report.files["health.json"] = out.dump(1) + "\n";
  return report;
}

HealthReport add_to_history(const std::string& folder, const std::string& robot, double day,
                            const std::vector<TendonFigures>& tendons,
                            const HealthOptions& options) {
  const std::filesystem::path place = folder;
  require_writable(folder);
  History history = History::load((place / "health.csv").string());
  history.add(day, tendons);
  HealthReport report = report_health(robot, history, tendons, options);
  std::filesystem::create_directories(place);
  history.save((place / "health.csv").string());
  write_files(folder, report.files);
  write_page("health", (place / "health.json").string(), (place / "health.html").string());
  return report;
}

}  // namespace health
}  // namespace anthrob
