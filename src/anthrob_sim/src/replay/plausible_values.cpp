#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {

namespace {

constexpr double kAbsurd = 1e9;        // in whatever unit
constexpr double kRangesBeyond = 2.0;  // of a joint, beyond its stops: degrees are 57 times as much
constexpr double kPush = 1.0;          // [N], more than the offset of a sensor

void refuse_no_number(const Dataset& recording, const Table& table, const Column& column) {
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (!column.present[i] || std::abs(column.values[i]) < kAbsurd) continue;
    refuse_row(recording, table, i,
               column.name + ": expected a finite number" +
                   (std::isfinite(column.values[i]) ? " below 1e9" : ""));
  }
}

void refuse_far_positions(const RobotModel& robot, const Dataset& recording, const Table& table,
                          const Column& column) {
  if (column.quantity() != "position") return;
  const int j = robot.skeleton->find_joint(column.owner());
  if (j < 0) return;
  const JointModel& joint = robot.skeleton->joints[static_cast<std::size_t>(j)];
  if (!joint.stop.enabled || joint.dof() > 1) return;
  const double low = joint.stop.lower, high = joint.stop.upper;
  const double beyond = kRangesBeyond * (high - low);
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    const double value = column.values[i];
    if (!column.present[i] || std::isnan(value)) continue;  // not measured
    if (value >= low - beyond && value <= high + beyond) continue;
    refuse_row(recording, table, i,
               column.name + ": " + short_number(value) +
                   ": expected a position of a joint that goes " + "from " + short_number(low) +
                   " to " + short_number(high) + " (in rad or m)");
  }
}

/// Where a tendon pushes most of the time. Noise and an offset may reach below zero.
void refuse_pushing_tendons(const RobotModel& robot, const Dataset& recording, const Table& table,
                            const Column& column) {
  const int muscle = column.quantity() == "force" ? robot.find_muscle(column.owner()) : -1;
  if (muscle < 0 || robot.muscles[muscle].is_drive()) return;
  std::size_t pushes = 0, count = 0, first = 0;
  for (std::size_t i = 0; i < column.values.size(); ++i) {
    if (!column.present[i]) continue;
    ++count;
    if (!(column.values[i] < -kPush)) continue;
    if (pushes++ == 0) first = i;
  }
  if (2 * pushes <= count) return;
  refuse_row(recording, table, first,
             column.name + ": " + short_number(column.values[first]) +
                 ": expected the tension of a tendon, which is not negative [N]");
}

}  // namespace

void refuse_row(const Dataset& recording, const Table& table, std::size_t row,
                const std::string& complaint) {
  throw BadInput(recording.folder + "/" + table.name + ".csv: row " + std::to_string(row + 1) +
                 ": " + complaint);
}

void refuse_no_numbers(const Dataset& recording) {
  for (const Table& table : recording.tables) {
    for (const Column& column : table.columns) refuse_no_number(recording, table, column);
  }
}

void refuse_implausible_values(const RobotModel& robot, const Dataset& recording) {
  for (const Table& table : recording.tables) {
    for (const Column& column : table.columns) {
      refuse_far_positions(robot, recording, table, column);
      refuse_pushing_tendons(robot, recording, table, column);
    }
  }
}

}  // namespace anthrob
