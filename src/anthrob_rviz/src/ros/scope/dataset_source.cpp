#include "ros/scope/dataset_source.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_recording/dataset.h"
#include "scope/message_reader.h"

namespace anthrob {
namespace {

/// The topic of a table in a bag.
std::string topic_of_table(const std::string& table) {
  if (table == "muscles") return "muscle_states";
  if (table == "commands") return "muscle_command";
  if (table == "joints") return "joint_states";
  if (table == "spherical_joints") return "spherical_joint_states";
  return table;
}

std::optional<std::string> unit_of_column(const std::string& table, const std::string& quantity) {
  if (table == "joints") return standard_unit("sensor_msgs/JointState", quantity);
  static const std::map<std::string, const char*> kUnits = {{"position", "rad"},
                                                            {"velocity", "rad/s"},
                                                            {"current", "A"},
                                                            {"voltage", "V"},
                                                            {"force", "N"}};
  const auto found = kUnits.find(quantity);
  if (table != "muscles" || found == kUnits.end()) return std::nullopt;
  return found->second;
}

/// The same names as those of a message, whose orientation and angular velocity have parts.
Quantity quantity_of(const std::string& topic, const Table& table, const Column& column) {
  const std::string quantity = column.quantity(), owner = column.owner();
  const auto make = [&](const std::string& field, const std::string& label,
                        std::optional<std::string> unit) {
    return Quantity{topic + "/" + field + "/" + label, topic, topic + "/" + field, label,
                    std::move(unit)};
  };
  const bool ball = table.name == "spherical_joints";
  if (ball && quantity.size() == 1)
    return make("orientation", owner + "/" + quantity, std::nullopt);
  if (ball && quantity.size() == 2)
    return make("angular_velocity", owner + "/" + quantity.substr(1), "rad/s");
  return make(quantity, owner, unit_of_column(table.name, quantity));
}

class DatasetSource final : public RecordingSource {
 public:
  explicit DatasetSource(const std::string& folder) {
    const Dataset dataset = Dataset::load(folder);
    remarks_ = dataset.remarks;
    std::string robot = dataset.meta.robot;
    if (robot.empty()) {
      robot = "anthrob";
      remarks_.push_back("no robot: in meta.yaml; shown as /anthrob");
    }
    for (const Table& table : dataset.tables)
      take("/" + robot + "/" + topic_of_table(table.name), table);
    if (quantities_.empty())
      throw BadInput(folder + ": no number; expected CSV files with columns");
    begin_ = dataset.begin();
  }

  const std::vector<Quantity>& quantities() const override { return quantities_; }
  const std::vector<std::string>& remarks() const override { return remarks_; }
  Nanoseconds begin() const override { return begin_; }

  std::map<std::string, std::vector<Sample>> load(const std::set<std::string>& paths) override {
    std::map<std::string, std::vector<Sample>> loaded;
    for (const std::string& path : paths) loaded[path] = samples_.at(path);
    return loaded;
  }

 private:
  void take(const std::string& topic, const Table& table) {
    for (const Column& column : table.columns) {
      std::vector<Sample> samples;
      for (std::size_t i = 0; i < table.t.size(); ++i) {
        if (column.present[i]) samples.push_back({table.t[i], column.values[i]});
      }
      add(quantity_of(topic, table, column), std::move(samples));
      if (table.name == "spherical_joints" && column.quantity() == "w")
        add_angle(topic, table, column);
    }
  }

  void add(const Quantity& quantity, std::vector<Sample> samples) {
    if (samples_.emplace(quantity.path, std::move(samples)).second) quantities_.push_back(quantity);
  }

  /// As of a quaternion in a message.
  void add_angle(const std::string& topic, const Table& table, const Column& w) {
    const std::string owner = w.owner(), label = owner + "/angle";
    const Column* parts[] = {&w, table.find(owner + "/x"), table.find(owner + "/y"),
                             table.find(owner + "/z")};
    std::vector<Sample> samples;
    for (std::size_t i = 0; i < table.t.size(); ++i) {
      double q[4];
      bool whole = true;
      for (int k = 0; k < 4; ++k) {
        whole = whole && parts[k] != nullptr && parts[k]->present[i];
        if (whole) q[k] = parts[k]->values[i];
      }
      if (whole) samples.push_back({table.t[i], angle_of(q[0], q[1], q[2], q[3])});
    }
    const std::string group = topic + "/orientation";
    add({group + "/" + label, topic, group + "/angle", label, "rad"}, std::move(samples));
  }

  std::vector<Quantity> quantities_;
  std::vector<std::string> remarks_;
  std::map<std::string, std::vector<Sample>> samples_;
  Nanoseconds begin_ = 0;
};

}  // namespace

std::unique_ptr<RecordingSource> open_dataset(const std::string& folder) {
  return std::make_unique<DatasetSource>(folder);
}

}  // namespace anthrob
