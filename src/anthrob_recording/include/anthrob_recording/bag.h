#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// What a bag holds beyond the four topics of a recording.
struct BagContents {
  Dataset dataset;
  std::vector<std::string> not_carried;  ///< other topics: "/tf (2040 messages)"
};

/// Differences between a written bag and its dataset folder, one line each.
struct BagRemarks {
  std::vector<std::string> not_carried;  ///< columns that no topic holds: "joints.csv: elbow/load"
  std::vector<std::string> remarks;      ///< columns written to another topic than their file's
};

/// Reads the topics muscle_command, muscle_states, joint_states and spherical_joint_states, in
/// whatever namespace they were recorded (one robot per bag), into the tables commands, muscles,
/// joints and spherical_joints. Every value and stamp is kept bit for bit. NAME.yaml beside
/// NAME.bag is its meta.yaml. Commands of several publishers may arrive out of order by up to
/// 0.5 s; they are sorted by their stamps, with a remark.
/// @throws BadInput naming the file if it is not a bag or a broken one, contains none of the topics
/// or topics of several robots, or if time goes backwards in it
BagContents read_bag(const std::string& file);

/// Writes a dataset as a bag. Topics get the namespace of `meta.robot`; the rest of `meta` is
/// written to NAME.yaml beside NAME.bag, replacing an existing file. topic_tables.h says which
/// column goes to which topic. A row without any cell becomes a message without names. Commands
/// without a mode get the one that a replay takes: the muscle's last one, before its first one the
/// first, POSITION if it has none anywhere (a replay takes VOLTAGE for a muscle without
/// controller).
/// @throws BadInput if a row cannot become a message (a quantity given for some names only, an
/// incomplete orientation or command, a time before 0), or if no column has a topic
BagRemarks write_bag(const Dataset& dataset, const std::string& file);

/// A recording from a dataset folder, a bag (by its ending `.bag`) or a bag of ROS 2: a file that
/// ends in `.db3`, or a folder with metadata.yaml.
/// @throws BadInput with one line
Dataset load_recording(const std::string& path);

/// The recordings in a folder (dataset folders and bags, in natural order of their names), or the
/// single recording at that path.
/// @throws BadInput with one line, also if there is none
std::vector<Dataset> load_recordings(const std::string& folder);

}  // namespace anthrob
