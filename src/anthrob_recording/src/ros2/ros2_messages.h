#pragma once

#include <cstddef>
#include <string>

#include "dataset/topic_rows.h"

namespace anthrob {

/// Type of a recording's topic in ROS 2: "sensor_msgs/msg/JointState" of "joint_states".
std::string ros2_type_of(const std::string& leaf);

/// What a serialised message of that topic says, but for when it arrived. Our own messages are laid
/// out as rosidl lays out our .msg files: a header of `int32 sec`, `uint32 nanosec` and `frame_id`,
/// durations of `int32 sec` and `uint32 nanosec`.
/// @throws CdrError for bytes that are no such message
TopicRow read_ros2_message(const std::string& leaf, const void* data, std::size_t size);

}  // namespace anthrob
