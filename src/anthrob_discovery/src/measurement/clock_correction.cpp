#include "measurement/clock_correction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "admission/clock_offsets.h"
#include "anthrob_core/text.h"
#include "experiment/poses.h"
#include "measurement/clock_fit.h"
#include "measurement/column_edits.h"

namespace anthrob {
namespace discovery {

namespace {

const double kPerMillion = 1e6;

/// From the beginning of the recording to the middle of a table [s].
double until_middle(const Dataset& recording, const std::string& name) {
  const Table& table = *recording.find_table(name);
  return 0.5 * (seconds(table.t.front()) + seconds(table.t.back())) - seconds(recording.begin());
}

/// Of the joints that are in a table.
std::string kind_of(const RobotModel& robot, const Table& table) {
  const auto joint =
      static_cast<std::size_t>(robot.skeleton->find_joint(table.columns.front().owner()));
  return robot.skeleton->joints[joint].type == JointType::kBall ? "orientation" : "joint position";
}

std::string line_about(const std::string& recording, const ClockOffset& offset) {
  return recording + "/" + offset.table + ".csv: joints seem to be stamped " +
         significant(std::abs(offset.late), 3) + " s too " +
         (offset.late > 0.0 ? "late" : "early") +
         ", by another clock than the muscles: with that shift, motor positions and forces "
         "explain " +
         significant(100.0 * offset.explained, 2) + " % of their motion, without it only " +
         significant(100.0 * offset.as_stamped, 2) + " %";
}

/// What one table's clock does in all recordings.
struct Drift {
  double weights = 0.0, sum = 0.0;

  void add(const ClockFit& fit) {
    const double weight = 1.0 / (fit.drift_sigma * fit.drift_sigma);
    weights += weight, sum += weight * fit.drift;
  }
  double value() const { return sum / weights; }
  double sigma() const { return 1.0 / std::sqrt(weights); }
  bool is_certain(const ClockFitOptions& options) const {
    return std::abs(value()) > options.sure * sigma() && std::abs(value()) < options.most_drift;
  }
};

using TableOf = std::pair<std::size_t, std::string>;  ///< recording and table

std::map<TableOf, ClockFit> fits_of(const RobotModel& robot,
                                    const std::vector<Dataset*>& recordings,
                                    const std::vector<std::optional<Dataset>>& simulated,
                                    const ClockFitOptions& options) {
  std::map<TableOf, ClockFit> fits;
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    if (!simulated[r]) continue;
    for (const Table& table : recordings[r]->tables) {
      const Table* other = simulated[r]->find_table(table.name);
      if (!other || !is_of_joints(robot, table)) continue;
      const auto fit = fit_clock(table, *other, options);
      if (fit && fit->drift_sigma > 0.0) fits[{r, table.name}] = *fit;
    }
  }
  return fits;
}

/// Drifts that are certain, by table.
std::map<std::string, double> report_drifts(const std::map<std::string, std::string>& kinds,
                                            const std::map<TableOf, ClockFit>& fits,
                                            const ClockFitOptions& options,
                                            Description& description) {
  std::map<std::string, Drift> drifts;
  for (const auto& [where, fit] : fits) drifts[where.second].add(fit);
  std::map<std::string, double> certain;
  for (const auto& [table, drift] : drifts) {
    if (!drift.is_certain(options)) continue;
    certain[table] = drift.value();
    const double value = kPerMillion * drift.value(),
                 half = kPerMillion * options.interval * drift.sigma();
    description.measurement.push_back(
        {kinds.at(table), table, "clock", value, {value - half, value + half}, "ppm", "found"});
    description.remarks.push_back(
        table + ".csv: its clock goes " + significant(std::abs(value), 2) + " ppm too " +
        (value > 0.0 ? "fast" : "slow") + " beside that of the muscles: put right");
  }
  return certain;
}

}  // namespace

bool is_of_joints(const RobotModel& robot, const Table& table) {
  if (table.name == "commands" || table.columns.empty()) return false;
  return std::all_of(table.columns.begin(), table.columns.end(), [&](const Column& column) {
    return robot.skeleton->find_joint(column.owner()) >= 0;
  });
}

void correct_clock_offsets(const RobotModel& robot, bool is_last, std::vector<MovedTable>& moved,
                           Description& description) {
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  for (std::size_t r = 0; r < recordings.size(); ++r) {
    if (holds_poses(robot, *recordings[r])) continue;
    for (const ClockOffset& offset :
         clock_offsets(robot, *recordings[r], description.question.options.admission)) {
      if (!offset.certain) {
        if (!is_last) continue;
        description.remarks.push_back(line_about(recordings[r]->folder, offset) +
                                      "; too few movements to put it right");
        continue;
      }
      move_clock(*recordings[r], offset.table, offset.late, 0.0);
      description.corrected = true;
      const auto before = std::find_if(moved.begin(), moved.end(), [&](const MovedTable& other) {
        return other.recording == r && other.offset.table == offset.table;
      });
      if (before == moved.end()) {
        moved.push_back({r, offset});
      } else {
        before->offset.late += offset.late;
      }
    }
  }
}

void correct_clocks(const RobotModel& robot, const std::vector<std::optional<Dataset>>& simulated,
                    const std::vector<MovedTable>& moved, Description& description) {
  const ClockFitOptions& options = description.question.options.measurement.clock;
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  const auto fits = fits_of(robot, recordings, simulated, options);
  std::map<std::string, std::string> kinds;
  for (const auto& [where, fit] : fits) {
    kinds[where.second] = kind_of(robot, *recordings[where.first]->find_table(where.second));
  }
  std::map<std::string, double> drifts = report_drifts(kinds, fits, options, description);
  for (const MovedTable& table : moved) {
    ClockOffset offset = table.offset;
    double half = description.question.options.admission.clocks.bin;
    const auto fit = fits.find({table.recording, offset.table});
    if (fit != fits.end()) {
      const double drift = drifts.count(offset.table) ? drifts[offset.table] : 0.0;
      const double rest =
          fit->second.late - drift * until_middle(*recordings[table.recording], offset.table);
      move_clock(*recordings[table.recording], offset.table, rest, 0.0);
      offset.late += rest;
      half = options.interval * fit->second.late_sigma;
    }
    const Table& own = *recordings[table.recording]->find_table(offset.table);
    description.measurement.push_back({kind_of(robot, own),
                                       offset.table,
                                       "clock",
                                       offset.late,
                                       {offset.late - half, offset.late + half},
                                       "s",
                                       "found"});
    description.remarks.push_back(line_about(recordings[table.recording]->folder, offset) +
                                  "; moved by it, so that a delay of the sensor is not known");
  }
  for (const auto& [where, fit] : fits) {
    const auto& [r, table] = where;
    if (!drifts.count(table)) continue;
    move_clock(*recordings[r], table, 0.0, drifts[table]);
    description.corrected = true;
  }
}

}  // namespace discovery
}  // namespace anthrob
