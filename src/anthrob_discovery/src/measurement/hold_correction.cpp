#include "measurement/hold_correction.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "anthrob_core/text.h"
#include "experiment/poses.h"
#include "measurement/held_samples.h"

namespace anthrob {
namespace discovery {

namespace {

/// Columns that one sensor fills.
struct SensorColumns {
  std::string place, kind;  ///< "shoulder", "orientation"
  std::vector<std::string> columns;
};

std::vector<SensorColumns> sensors_of(const RobotModel& robot) {
  std::vector<SensorColumns> sensors;
  for (const MuscleModel& muscle : robot.muscles) {
    for (const char* kind : {"position", "velocity", "current", "force"}) {
      sensors.push_back({muscle.name, kind, {muscle.name + "/" + kind}});
    }
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    const std::string& name = joint.name;
    if (joint.type == JointType::kBall) {
      sensors.push_back(
          {name, "orientation", {name + "/w", name + "/x", name + "/y", name + "/z"}});
    } else {
      sensors.push_back({name, "joint position", {name + "/position"}});
    }
  }
  return sensors;
}

const Table* table_of(const Dataset& recording, const std::vector<std::string>& columns) {
  for (const Table& table : recording.tables) {
    if (table.name != "commands" &&
        std::all_of(columns.begin(), columns.end(),
                    [&](const std::string& name) { return table.find(name) != nullptr; })) {
      return &table;
    }
  }
  return nullptr;
}

/// FreshRates of the same sensor in all recordings.
struct FreshRates {
  std::size_t recordings = 0;
  double sum = 0.0, low = 0.0, high = 0.0;  ///< [Hz]
  double rows = 0.0;                        ///< of the last one [Hz]

  void add(const HeldSamples& held) {
    const double own_low = 1.0 / (held.period + held.uncertainty),
                 own_high = 1.0 / (held.period - held.uncertainty);
    low = recordings == 0 ? own_low : std::min(low, own_low);
    high = recordings == 0 ? own_high : std::max(high, own_high);
    sum += 1.0 / held.period;
    rows = 1.0 / held.row_period;
    ++recordings;
  }
  double mean() const { return sum / static_cast<double>(recordings); }
};

MeasurementProperty hold_property(const std::string& kind, const std::string& place,
                                  const FreshRates& rates) {
  return {kind, place, "hold", rates.mean(), {rates.low, rates.high}, "Hz", "found"};
}

std::string remark_on_hold(const MeasurementProperty& hold, double rows) {
  return (hold.place == "all" ? "all of kind " + hold.channel_kind
                              : hold.place + "/" + hold.channel_kind) +
         ": fresh only " + significant(hold.value, 4) + " times a second in rows at " +
         significant(rows, 4) + " Hz, which repeat it: compared only where it is fresh";
}

/// Sensors of one kind, by their places.
void report_holds(const std::string& kind, const std::map<std::string, FreshRates>& by_place,
                  bool is_all, double alike, Description& description) {
  FreshRates all;
  for (const auto& [place, rates] : by_place) {
    if (all.recordings == 0) all = rates;
    all.low = std::min(all.low, rates.low), all.high = std::max(all.high, rates.high);
  }
  if (is_all && by_place.size() > 1 && all.high - all.low < alike * all.mean()) {
    description.measurement.push_back(hold_property(kind, "all", all));
    description.remarks.push_back(remark_on_hold(description.measurement.back(), all.rows));
    return;
  }
  for (const auto& [place, rates] : by_place) {
    description.measurement.push_back(hold_property(kind, place, rates));
    description.remarks.push_back(remark_on_hold(description.measurement.back(), rates.rows));
  }
}

}  // namespace

void correct_holds(const RobotModel& robot, Description& description) {
  Question& question = description.question;
  const std::vector<SensorColumns> sensors = sensors_of(robot);
  std::map<std::string, std::map<std::string, FreshRates>> found;  // by kind and place
  std::map<std::string, std::size_t> places;
  for (const SensorColumns& sensor : sensors) ++places[sensor.kind];
  for (Dataset* recording : recordings_of(question)) {
    if (holds_poses(robot, *recording)) continue;  // its times mean nothing
    for (const SensorColumns& sensor : sensors) {
      const Table* table = table_of(*recording, sensor.columns);
      if (!table) continue;
      const auto held = find_held(*table, sensor.columns, question.options.measurement.hold);
      if (!held) continue;
      found[sensor.kind][sensor.place].add(*held);
      retime(*recording, std::string(table->name), sensor.columns,
             table->name + " of " + sensor.place + "/" + sensor.kind, held->taken);
      description.corrected = true;
    }
  }
  for (const auto& [kind, by_place] : found) {
    report_holds(kind, by_place, by_place.size() == places[kind],
                 question.options.measurement.hold.alike, description);
  }
}

}  // namespace discovery
}  // namespace anthrob
