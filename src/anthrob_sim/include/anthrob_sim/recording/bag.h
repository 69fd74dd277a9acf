#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// What a bag holds beyond the four topics of a recording.
struct BagContents {
  Dataset dataset;
  std::vector<std::string> not_carried;  ///< other topics: "/tf (2040 messages)"
};

/// What a bag does not show as the dataset folder did, one line each.
struct BagRemarks {
  std::vector<std::string> not_carried;  ///< columns: "joints.csv: elbow/load"
  std::vector<std::string> remarks;      ///< what went elsewhere than its file says
};

/// Reads the topics muscle_command, muscle_states, joint_states and spherical_joint_states, in
/// whatever namespace they were recorded (one robot a bag), into the tables commands, muscles,
/// joints and spherical_joints. Every value and stamp is kept bit for bit. NAME.yaml beside
/// NAME.bag is its meta.yaml. Commands of several publishers, which may overtake each other by up
/// to 0.5 s, come in the order of their stamps, with a remark.
/// @throws BadInput naming the file if it is no bag or a broken one, holds none of the topics, or
/// topics of several robots, or time goes backwards in it
BagContents read_bag(const std::string& file);

/// The other way. Topics get the namespace of `meta.robot`; the rest of `meta` goes to NAME.yaml
/// beside NAME.bag, in place of what stood there. Which column goes to which topic: topic_tables.h.
/// A row without any cell becomes a message without names.
/// @throws BadInput if rows do not make messages: a quantity of some names only, an orientation or
/// a command that is not whole, times before 0; or nothing has a topic
BagRemarks write_bag(const Dataset& dataset, const std::string& file);

}  // namespace anthrob
