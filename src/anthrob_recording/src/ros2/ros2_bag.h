#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// Whether a path is meant as a bag of ROS 2: it ends in .db3, or is a folder with metadata.yaml.
bool is_ros2_bag(const std::string& path);

/// Reads a bag of ROS 2 (rosbag2, storage sqlite3, serialisation cdr, not compressed) as read_bag()
/// reads one of ROS 1: the same topics, whatever the robot's namespace. The description is
/// NAME.yaml beside NAME.db3, or meta.yaml in the folder.
/// @param not_carried gets the other topics: "/tf (2040 messages)"
/// @throws BadInput with one line: file, topic, message, what was expected
Dataset read_ros2_bag(const std::string& path, std::vector<std::string>* not_carried = nullptr);

}  // namespace anthrob
