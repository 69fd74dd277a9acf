#include "replay/recorded_pushes.h"

#include <cmath>
#include <map>

#include "anthrob_core/text.h"
#include "anthrob_recording/quantities.h"
#include "anthrob_sim/core/errors.h"

namespace anthrob {

namespace {

/// The number of a wrench that a quantity such as "force_x" stands for.
double& component(Wrench& wrench, const std::string& quantity) {
  Vec3& vector = quantity[0] == 'f'   ? wrench.force
                 : quantity[0] == 't' ? wrench.torque
                                      : wrench.point;
  return vector[quantity.back() - 'x'];
}

PushRow row_of(const SkeletonModel& skeleton, const Dataset& recording, const Table& table,
               std::size_t i) {
  std::map<std::string, Wrench> wrenches;
  for (const Column& column : table.columns) {
    if (!column.present[i]) continue;
    if (!std::isfinite(column.values[i])) {
      throw BadInput(recording.folder + "/" + table.name + ".csv: row " + std::to_string(i + 1) +
                     ": " + column.name + ": " + exact_text(column.values[i]) +
                     ": expected a finite number: it drives the replay");
    }
    Wrench& wrench = wrenches[column.owner()];
    wrench.frame = skeleton.find_frame(pushed_link(column.owner()));
    component(wrench, column.quantity()) = column.values[i];
  }
  PushRow row{seconds(table.t[i] - recording.begin()), {}};
  for (const auto& [owner, wrench] : wrenches) row.wrenches.push_back(wrench);
  return row;
}

}  // namespace

std::string pushed_link(const std::string& owner) {
  return owner.substr(0, owner.find(':'));
}

std::vector<PushRow> recorded_pushes(const SkeletonModel& skeleton, const Dataset& recording) {
  std::vector<PushRow> rows;
  const Table* table = recording.find_table("wrenches");
  if (table == nullptr) return rows;
  for (const Column& column : table->columns) {
    if (is_push_quantity(column.quantity()) &&
        skeleton.find_frame(pushed_link(column.owner())) >= 0)
      continue;
    throw BadInput(recording.folder + "/wrenches.csv: column '" + column.name +
                   "': expected LINK/force_x, torque_x, point_x, ... of a link of the robot");
  }
  for (std::size_t i = 0; i < table->t.size(); ++i)
    rows.push_back(row_of(skeleton, recording, *table, i));
  return rows;
}

}  // namespace anthrob
