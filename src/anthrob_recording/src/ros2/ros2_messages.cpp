#include "ros2/ros2_messages.h"

#include <map>

#include "ros2/cdr_reader.h"

namespace anthrob {
namespace {

/// What follows the last value at most: the padding to a multiple of four bytes (RTPS).
constexpr std::size_t kMostPadding = 3;

void read_header(CdrReader& in, TopicRow& row) {
  const Nanoseconds sec = in.integer_32();
  const Nanoseconds nanosec = in.count_32();
  if (nanosec >= 1000000000) throw CdrError("a stamp of a second or more in nanoseconds");
  row.stamp = sec * 1000000000 + nanosec;
  row.frame = in.text();
}

template <class Numbers>
void put(const Numbers& numbers, const std::string& quantity, bool optional, TopicRow& row) {
  if (numbers.size() != row.owners.size() && !(optional && numbers.empty())) row.complete = false;
  if (!row.complete) return;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    row.cells.emplace_back(row.owners[i] + "/" + quantity, static_cast<double>(numbers[i]));
  }
}

void read_command(CdrReader& in, TopicRow& row) {
  row.owners = in.texts();
  put(in.bytes(), "mode", false, row);
  put(in.numbers(), "reference", false, row);
}

void read_muscles(CdrReader& in, TopicRow& row) {
  row.owners = in.texts();
  for (const char* quantity :
       {"position", "velocity", "current", "voltage", "force", "reference"}) {
    put(in.numbers(), quantity, true, row);
  }
  put(in.bytes(), "mode", true, row);
  put(in.bytes(), "ecu_state", true, row);
}

void read_joints(CdrReader& in, TopicRow& row) {
  row.owners = in.texts();
  for (const char* quantity : {"position", "velocity", "effort"}) {
    put(in.numbers(), quantity, true, row);
  }
}

/// A list of structures of numbers, one list for each of their members.
std::vector<std::vector<double>> read_structures(CdrReader& in, std::size_t members) {
  const std::size_t count = in.sequence(8 * members, 8);
  std::vector<std::vector<double>> lists(members, std::vector<double>(count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::vector<double>& list : lists) list[i] = in.number();
  }
  return lists;
}

void read_balls(CdrReader& in, TopicRow& row) {
  row.owners = in.texts();
  const auto turns = read_structures(in, 4);
  const char* const parts[] = {"x", "y", "z", "w"};  // as geometry_msgs/Quaternion has them
  for (const std::size_t k : {3u, 0u, 1u, 2u}) put(turns[k], parts[k], true, row);
  const auto rates = read_structures(in, 3);
  const char* const axes[] = {"wx", "wy", "wz"};
  for (std::size_t k = 0; k < 3; ++k) put(rates[k], axes[k], true, row);
}

void read_wrenches(CdrReader& in, TopicRow& row) {
  std::map<std::string, int> counts;
  for (const std::string& link : in.texts()) {  // a second push of a link is LINK:2
    const int count = ++counts[link];
    row.owners.push_back(count == 1 ? link : link + ":" + std::to_string(count));
  }
  const auto points = read_structures(in, 3);
  const auto wrenches = read_structures(in, 6);
  const std::size_t left = in.sequence(8, 4);
  for (std::size_t i = 0; i < 2 * left; ++i) in.count_32();  // durations: for how long
  const char* const parts[] = {"force_x", "force_y", "force_z", "torque_x", "torque_y", "torque_z"};
  for (std::size_t k = 0; k < 6; ++k) put(wrenches[k], parts[k], false, row);
  const char* const places[] = {"point_x", "point_y", "point_z"};
  for (std::size_t k = 0; k < 3; ++k) put(points[k], places[k], false, row);
}

struct Message {
  const char* type;
  void (*read)(CdrReader& in, TopicRow& row);
};

const Message& message_of(const std::string& leaf) {
  static const std::map<std::string, Message> kMessages = {
      {"muscle_command", {"anthrob_msgs/msg/MuscleCommand", read_command}},
      {"muscle_states", {"anthrob_msgs/msg/MuscleStates", read_muscles}},
      {"joint_states", {"sensor_msgs/msg/JointState", read_joints}},
      {"spherical_joint_states", {"anthrob_msgs/msg/SphericalJointStates", read_balls}},
      {"external_wrenches", {"anthrob_msgs/msg/ExternalWrenches", read_wrenches}}};
  return kMessages.at(leaf);
}

TopicRow read_laid_out(const std::string& leaf, const void* data, std::size_t size,
                       CdrReader::EmptySequence empty) {
  CdrReader in(data, size, empty);
  TopicRow row;
  read_header(in, row);
  message_of(leaf).read(in, row);
  if (in.left() > kMostPadding) {
    throw CdrError(std::to_string(in.left()) + " bytes beyond its last value");
  }
  return row;
}

}  // namespace

std::string ros2_type_of(const std::string& leaf) {
  return message_of(leaf).type;
}

TopicRow read_ros2_message(const std::string& leaf, const void* data, std::size_t size) {
  try {
    return read_laid_out(leaf, data, size, CdrReader::EmptySequence::kNothing);
  } catch (const CdrError& error) {
    // Only one of the two readings ends where the message does.
    try {
      return read_laid_out(leaf, data, size, CdrReader::EmptySequence::kAligned);
    } catch (const CdrError&) {
      throw CdrError(error);
    }
  }
}

}  // namespace anthrob
