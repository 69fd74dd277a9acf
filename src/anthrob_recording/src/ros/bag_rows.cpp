#include "ros/bag_rows.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string_view>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

using anthrob_msgs::ExternalWrenches;
using anthrob_msgs::MuscleCommand;
using anthrob_msgs::MuscleStates;
using anthrob_msgs::SphericalJointStates;
using sensor_msgs::JointState;

template <class Numbers>
bool fits(const std::vector<std::string>& names, const Numbers& numbers, bool optional) {
  return numbers.size() == names.size() || (optional && numbers.empty());
}

template <class Numbers>
void put(const std::vector<std::string>& names, const Numbers& numbers, const std::string& quantity,
         Cells& cells) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    cells.emplace_back(names[i] + "/" + quantity, static_cast<double>(numbers[i]));
  }
}

template <class M>
void put_vector(const std::string& owner, const M& vector, Cells& cells) {
  cells.emplace_back(owner + "_x", vector.x);
  cells.emplace_back(owner + "_y", vector.y);
  cells.emplace_back(owner + "_z", vector.z);
}

/// One row of a table, seen by owner.
class RowView {
 public:
  RowView(const Table& table, std::size_t row) : table_(table), row_(row) {
    for (const Column& column : table.columns) {
      if (!column.present[row]) continue;
      const std::string owner = column.owner();
      if (std::find(owners_.begin(), owners_.end(), owner) == owners_.end())
        owners_.push_back(owner);
    }
  }
  const std::vector<std::string>& owners() const { return owners_; }

  /// All owners' values of a quantity; none if not one owner has it.
  template <class Numbers>
  void get(const std::string& quantity, Numbers& numbers) const {
    numbers.clear();
    for (const std::string& owner : owners_) {
      const Column* column = table_.find(owner + "/" + quantity);
      if (column && column->present[row_]) {
        numbers.push_back(static_cast<typename Numbers::value_type>(column->values[row_]));
      }
    }
    if (!numbers.empty() && numbers.size() != owners_.size()) {
      fail("'" + quantity +
           "' is given for some names only; a message needs it for all names or for none");
    }
  }

  /// x, y and z of one owner; zero where there is no cell.
  template <class M>
  void get_vector(const std::string& name, M& vector) const {
    const std::pair<const char*, double*> parts[] = {
        {"_x", &vector.x}, {"_y", &vector.y}, {"_z", &vector.z}};
    for (const auto& [part, value] : parts) {
      const Column* column = table_.find(name + part);
      *value = column && column->present[row_] ? column->values[row_] : 0.0;
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(table_.name + ".csv: row at t = " + time_text(table_.t[row_]) + ": " + message);
  }

 private:
  const Table& table_;
  std::size_t row_;
  std::vector<std::string> owners_;
};

}  // namespace

bool to_cells(const MuscleCommand& m, Cells& cells) {
  if (!fits(m.name, m.mode, false) || !fits(m.name, m.reference, false)) return false;
  put(m.name, m.mode, "mode", cells);
  put(m.name, m.reference, "reference", cells);
  return true;
}

bool to_cells(const MuscleStates& m, Cells& cells) {
  const std::pair<const std::vector<double>*, const char*> lists[] = {
      {&m.position, "position"}, {&m.velocity, "velocity"}, {&m.current, "current"},
      {&m.voltage, "voltage"},   {&m.force, "force"},       {&m.reference, "reference"}};
  for (const auto& [list, quantity] : lists) {
    if (!fits(m.name, *list, true)) return false;
    put(m.name, *list, quantity, cells);
  }
  if (!fits(m.name, m.mode, true) || !fits(m.name, m.ecu_state, true)) return false;
  put(m.name, m.mode, "mode", cells);
  put(m.name, m.ecu_state, "ecu_state", cells);
  return true;
}

bool to_cells(const JointState& m, Cells& cells) {
  const std::pair<const std::vector<double>*, const char*> lists[] = {
      {&m.position, "position"}, {&m.velocity, "velocity"}, {&m.effort, "effort"}};
  for (const auto& [list, quantity] : lists) {
    if (!fits(m.name, *list, true)) return false;
    put(m.name, *list, quantity, cells);
  }
  return true;
}

bool to_cells(const SphericalJointStates& m, Cells& cells) {
  if (!fits(m.name, m.orientation, true) || !fits(m.name, m.angular_velocity, true)) return false;
  for (std::size_t i = 0; i < m.orientation.size(); ++i) {
    const auto& q = m.orientation[i];
    cells.insert(cells.end(), {{m.name[i] + "/w", q.w},
                               {m.name[i] + "/x", q.x},
                               {m.name[i] + "/y", q.y},
                               {m.name[i] + "/z", q.z}});
  }
  for (std::size_t i = 0; i < m.angular_velocity.size(); ++i) {
    const auto& w = m.angular_velocity[i];
    cells.insert(cells.end(),
                 {{m.name[i] + "/wx", w.x}, {m.name[i] + "/wy", w.y}, {m.name[i] + "/wz", w.z}});
  }
  return true;
}

std::vector<std::string> owners_of(const ExternalWrenches& m) {
  std::vector<std::string> owners;
  std::map<std::string, int> counts;
  for (const std::string& link : m.link) {
    const int count = ++counts[link];
    owners.push_back(count == 1 ? link : link + ":" + std::to_string(count));
  }
  return owners;
}

bool to_cells(const ExternalWrenches& m, Cells& cells) {
  if (!fits(m.link, m.wrench, false) || !fits(m.link, m.point, false)) return false;
  const std::vector<std::string> owners = owners_of(m);
  for (std::size_t i = 0; i < owners.size(); ++i) {
    put_vector(owners[i] + "/force", m.wrench[i].force, cells);
    put_vector(owners[i] + "/torque", m.wrench[i].torque, cells);
    put_vector(owners[i] + "/point", m.point[i], cells);
  }
  return true;
}

void from_row(const Table& table, std::size_t index, MuscleCommand& m) {
  const RowView row(table, index);
  m.name = row.owners();
  row.get("mode", m.mode);
  row.get("reference", m.reference);
  if (m.reference.empty() && !m.name.empty()) row.fail("expected a reference in a row of commands");
}

void from_row(const Table& table, std::size_t index, MuscleStates& m) {
  const RowView row(table, index);
  m.name = row.owners();
  row.get("position", m.position);
  row.get("velocity", m.velocity);
  row.get("current", m.current);
  row.get("voltage", m.voltage);
  row.get("force", m.force);
  row.get("reference", m.reference);
  row.get("mode", m.mode);
  row.get("ecu_state", m.ecu_state);
}

void from_row(const Table& table, std::size_t index, JointState& m) {
  const RowView row(table, index);
  m.name = row.owners();
  row.get("position", m.position);
  row.get("velocity", m.velocity);
  row.get("effort", m.effort);
}

void from_row(const Table& table, std::size_t index, SphericalJointStates& m) {
  const RowView row(table, index);
  m.name = row.owners();
  std::vector<double> w, x, y, z, wx, wy, wz;
  row.get("w", w), row.get("x", x), row.get("y", y), row.get("z", z);
  row.get("wx", wx), row.get("wy", wy), row.get("wz", wz);
  if (x.size() != w.size() || y.size() != w.size() || z.size() != w.size()) {
    row.fail("an orientation without all of w, x, y and z");
  }
  if (wy.size() != wx.size() || wz.size() != wx.size()) {
    row.fail("an angular velocity without all of wx, wy and wz");
  }
  m.orientation.resize(w.size());
  m.angular_velocity.resize(wx.size());
  for (std::size_t i = 0; i < w.size(); ++i) {
    m.orientation[i].w = w[i], m.orientation[i].x = x[i];
    m.orientation[i].y = y[i], m.orientation[i].z = z[i];
  }
  for (std::size_t i = 0; i < wx.size(); ++i) {
    m.angular_velocity[i].x = wx[i], m.angular_velocity[i].y = wy[i],
    m.angular_velocity[i].z = wz[i];
  }
}

void from_row(const Table& table, std::size_t index, ExternalWrenches& m) {
  const RowView row(table, index);
  for (const std::string& owner : row.owners()) {
    m.link.push_back(owner.substr(0, owner.find(':')));
    m.point.emplace_back();
    m.wrench.emplace_back();
    row.get_vector(owner + "/force", m.wrench.back().force);
    row.get_vector(owner + "/torque", m.wrench.back().torque);
    row.get_vector(owner + "/point", m.point.back());
    m.left.emplace_back(0.0);
  }
}

}  // namespace anthrob
