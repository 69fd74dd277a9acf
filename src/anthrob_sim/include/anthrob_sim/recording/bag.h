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

/// Reads the topics muscle_command, muscle_states, joint_states and spherical_joint_states, in
/// whatever namespace they were recorded (one robot a bag), into the tables commands, muscles,
/// joints and spherical_joints. Every value and stamp is kept bit for bit. NAME.yaml beside
/// NAME.bag is its meta.yaml.
/// @throws BadInput naming the file if it is no bag or a broken one, holds none of the topics, or
/// topics of several robots
BagContents read_bag(const std::string& file);

/// The other way. Topics get the namespace of `meta.robot`; the rest of `meta` goes to NAME.yaml
/// beside NAME.bag, in place of what stood there.
/// @throws BadInput if the dataset holds what these topics cannot carry
void write_bag(const Dataset& dataset, const std::string& file);

}  // namespace anthrob
