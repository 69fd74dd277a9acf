#include "experiment/poses.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace discovery {

namespace {

const JointModel* first_driven(const RobotModel& robot) {
  for (const JointModel& joint : robot.skeleton->joints) {
    if (joint.driven) return &joint;
  }
  return nullptr;
}

const Table& table_of_poses(const RobotModel& robot, const Dataset& recording) {
  const JointModel* joint = first_driven(robot);
  for (const Table& table : recording.tables) {
    if (joint && table.find(joint->name + "/position")) return table;
  }
  throw BadInput(recording.folder + ": column '" + (joint ? joint->name : "<joint>") +
                 "/position' is missing: expected the pose of a driven joint in each row");
}

/// A column of the poses; nothing if it is in no file.
/// @throws BadInput if it is in another file
const Column* column_of(const Dataset& recording, const Table& poses, const std::string& name) {
  if (const Column* column = poses.find(name)) return column;
  for (const Table& table : recording.tables) {
    if (!table.find(name)) continue;
    throw BadInput(recording.folder + "/" + table.name + ".csv: " + name + ": expected it in " +
                   poses.name + ".csv, beside the positions: a row is a pose");
  }
  return nullptr;
}

/// What a pose consists of.
struct PoseColumns {
  std::vector<const Column*> needed;                 ///< in each row
  std::vector<const Column*> positions, directions;  ///< by driven joint; direction: may be null
};

PoseColumns columns_of(const RobotModel& robot, const Dataset& recording, const Table& poses) {
  PoseColumns columns;
  for (const JointModel& joint : robot.skeleton->joints) {
    if (!joint.driven) continue;
    for (const char* quantity : {"/position", "/effort"}) {
      const Column* column = column_of(recording, poses, joint.name + quantity);
      if (!column) {
        throw BadInput(recording.folder + ": column '" + joint.name + quantity +
                       "' is missing: expected it of each driven joint in a recording of poses");
      }
      columns.needed.push_back(column);
    }
    columns.positions.push_back(poses.find(joint.name + "/position"));
    if (const Column* load = column_of(recording, poses, joint.name + "/load")) {
      columns.needed.push_back(load);
    }
    columns.directions.push_back(column_of(recording, poses, joint.name + "/direction"));
  }
  return columns;
}

double direction_at(const Column* column, std::size_t row) {
  return column && column->present[row] ? column->values[row] : 0.0;
}

void refuse_other_directions(const Dataset& recording, const Table& poses,
                             const PoseColumns& columns) {
  for (const Column* column : columns.directions) {
    for (std::size_t row = 0; column && row < poses.t.size(); ++row) {
      const double value = direction_at(column, row);
      if (value == 0.0 || std::abs(value) == 1.0) continue;
      refuse_row(recording, poses, row,
                 column->name + ": " + short_number(value) +
                     ": expected 1 (approached with growing position), -1 or 0 (unknown)");
    }
  }
}

/// Rows in which all is measured.
std::vector<std::size_t> complete_rows(const Table& poses, const PoseColumns& columns) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < poses.t.size(); ++row) {
    const bool complete =
        std::all_of(columns.needed.begin(), columns.needed.end(), [&](const Column* column) {
          return column->present[row] && std::isfinite(column->values[row]);
        });
    if (complete) rows.push_back(row);
  }
  return rows;
}

/// Directions, then positions.
std::vector<double> place_in_order(const PoseColumns& columns, std::size_t row) {
  std::vector<double> key;
  for (const Column* column : columns.directions) key.push_back(direction_at(column, row));
  for (const Column* column : columns.positions) key.push_back(column->values[row]);
  return key;
}

Table rows_in_order(const Table& poses, const std::vector<std::size_t>& rows, double seconds) {
  Table ordered;
  ordered.name = poses.name;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ordered.t.push_back(
        static_cast<Nanoseconds>(std::llround(1e9 * seconds * static_cast<double>(i))));
  }
  for (const Column& column : poses.columns) {
    Column own{column.name, {}, {}};
    const bool direction = column.quantity() == "direction";
    for (const std::size_t row : rows) {
      own.values.push_back(direction ? direction_at(&column, row) : column.values[row]);
      own.present.push_back(direction ? 1 : column.present[row]);
    }
    ordered.columns.push_back(std::move(own));
  }
  return ordered;
}

}  // namespace

bool holds_poses(const RobotModel& robot, const Dataset& recording) {
  return robot.muscles.empty() && recording.meta.kind == "equilibrium";
}

Dataset ordered_poses(const RobotModel& robot, const Dataset& recording, const PoseOptions& options,
                      std::vector<std::string>* remarks) {
  const Table& poses = table_of_poses(robot, recording);
  const PoseColumns columns = columns_of(robot, recording, poses);
  refuse_other_directions(recording, poses, columns);
  std::vector<std::size_t> rows = complete_rows(poses, columns);
  const std::string file = recording.folder + "/" + poses.name + ".csv";
  if (rows.size() < options.fewest) {
    throw BadInput(file + ": too few poses: " + std::to_string(rows.size()) +
                   " rows with all positions, efforts and loads; expected at least " +
                   std::to_string(options.fewest));
  }
  if (remarks && rows.size() < poses.t.size()) {
    remarks->push_back(file + ": " + std::to_string(poses.t.size() - rows.size()) + " of " +
                       std::to_string(poses.t.size()) +
                       " rows lack a position, effort or load, and are left out");
  }
  if (remarks && recording.tables.size() > 1) {
    remarks->push_back(recording.folder + ": only the poses in " + poses.name +
                       ".csv are used; times of other files mean nothing beside them");
  }
  std::stable_sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
    return place_in_order(columns, a) < place_in_order(columns, b);
  });
  Dataset ordered;
  ordered.folder = recording.folder;
  ordered.meta = recording.meta;
  ordered.remarks = recording.remarks;
  ordered.tables = {rows_in_order(poses, rows, options.seconds)};
  return ordered;
}

}  // namespace discovery
}  // namespace anthrob
