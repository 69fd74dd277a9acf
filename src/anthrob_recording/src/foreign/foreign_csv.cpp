#include "foreign/foreign_csv.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "anthrob_core/errors.h"
#include "dataset/clocks.h"
#include "foreign/time_base.h"

namespace anthrob {
namespace {

constexpr const char* kParts[] = {"/w", "/x", "/y", "/z"};

std::set<ForeignColumn> wanted_by(const ForeignStream& stream) {
  std::set<ForeignColumn> wanted;
  for (const ForeignStream::Entry& entry : stream.entries) entry.from.collect(wanted);
  for (const ForeignStream::Orientation& orientation : stream.orientations) {
    for (const ForeignValue& from : orientation.from) from.collect(wanted);
  }
  return wanted;
}

void put(Table& table, const std::string& name, const std::vector<double>& values) {
  Column& column = table.column(name);
  for (std::size_t row = 0; row < values.size(); ++row) {
    column.present[row] = std::isfinite(values[row]);
    column.values[row] = column.present[row] ? values[row] : 0.0;
  }
}

void put_entry(const ForeignStream::Entry& entry, const ForeignSheet& sheet, Table& table) {
  std::vector<double> values = entry.from.of(sheet);
  for (double& value : values) value = entry.scale * value + entry.offset;
  put(table, entry.to, values);
  if (!entry.mode) return;
  for (double& value : values) value = std::isfinite(value) ? *entry.mode : value;
  put(table, Column{entry.to, {}, {}}.owner() + "/mode", values);
}

void put_orientation(const ForeignStream::Orientation& orientation, const ForeignSheet& sheet,
                     Table& table) {
  std::array<std::vector<double>, 3> angles;
  for (std::size_t k = 0; k < 3; ++k) angles[k] = orientation.from[k].of(sheet);
  std::array<std::vector<double>, 4> parts;
  for (std::size_t row = 0; row < sheet.stamp.size(); ++row) {
    const Eigen::Vector3d turn =
        orientation.unit * Eigen::Vector3d(angles[0][row], angles[1][row], angles[2][row]);
    Eigen::Vector4d xyzw = Eigen::Vector4d::Constant(std::numeric_limits<double>::quiet_NaN());
    if (turn.allFinite()) {
      xyzw = (orientation.order.empty() ? from_rotation_vector(turn)
                                        : from_euler(orientation.order, turn))
                 .coeffs();
    }
    for (int k = 0; k < 4; ++k) parts[static_cast<std::size_t>(k)].push_back(xyzw[(k + 3) % 4]);
  }
  for (std::size_t k = 0; k < 4; ++k) put(table, orientation.joint + kParts[k], parts[k]);
}

Dataset read_stream(const std::string& file, const ForeignStream& stream) {
  const ForeignSheet sheet = read_foreign_sheet(file, stream.format, wanted_by(stream));
  Dataset dataset;
  const auto table = [&](const std::string& name) -> Table& {
    Table& found = dataset.table(name);
    found.t = sheet.stamp;
    return found;
  };
  for (const ForeignStream::Entry& entry : stream.entries) {
    put_entry(entry, sheet, table(entry.table));
  }
  for (const ForeignStream::Orientation& orientation : stream.orientations) {
    put_orientation(orientation, sheet, table(orientation.table));
  }
  return dataset;
}

std::string file_of(const std::string& path, const ForeignStream& stream,
                    const ForeignColumns& columns) {
  const bool folder = std::filesystem::is_directory(path);
  if (stream.name.empty() && folder) {
    throw BadInput(path + ": is a folder; expected a CSV file, because " + columns.file +
                   " has no 'streams'");
  }
  if (stream.name.empty()) return path;
  if (!folder) {
    throw BadInput(path + ": expected the folder of the files that 'streams' names in " +
                   columns.file);
  }
  return (std::filesystem::path(path) / stream.file).string();
}

/// Without a time base, a file of the dataset folder has the times of one stream.
void refuse_shared_tables(const Dataset& dataset, const ForeignColumns& columns) {
  std::set<std::string> seen;
  for (const Table& table : dataset.tables) {
    if (columns.rows > 0.0 || seen.insert(table.name).second) continue;
    throw BadInput(columns.file + ": table " + table.name +
                   ": two streams have it; expected one stream for each, or rows: RATE");
  }
}

Eigen::Quaterniond one_of_two(const Eigen::Quaterniond& q) {
  return q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q;
}

}  // namespace

Eigen::Quaterniond from_euler(const std::string& order, const Eigen::Vector3d& angles) {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(order[static_cast<std::size_t>(k)] - 'x');
    q = q * Eigen::AngleAxisd(angles[k], axis);
  }
  return one_of_two(q.normalized());
}

Eigen::Quaterniond from_rotation_vector(const Eigen::Vector3d& rotation) {
  const double angle = rotation.stableNorm();
  if (angle == 0.0) return Eigen::Quaterniond::Identity();
  return one_of_two(Eigen::Quaterniond(Eigen::AngleAxisd(angle, rotation / angle)).normalized());
}

Dataset read_foreign_csv(const std::string& path, const ForeignColumns& columns) {
  std::vector<Table> tables;
  for (const ForeignStream& stream : columns.streams) {
    for (Table& table : read_stream(file_of(path, stream, columns), stream).tables) {
      tables.push_back(std::move(table));
    }
  }
  Dataset dataset;
  dataset.folder = path;
  dataset.meta = columns.meta;
  dataset.tables = std::move(tables);
  refuse_shared_tables(dataset, columns);
  check_clocks(dataset);
  if (columns.rows > 0.0) dataset.tables = on_time_base(dataset.tables, columns.rows);
  return dataset;
}

}  // namespace anthrob
