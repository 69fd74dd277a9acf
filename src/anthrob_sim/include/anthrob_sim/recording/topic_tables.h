#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/recording/dataset.h"

namespace anthrob {

/// A recording by the topics it goes to.
struct TopicTables {
  /// Named commands, muscles, joints or spherical_joints; several may have one name. A row without
  /// any cell is a message without names.
  std::vector<Table> tables;
  std::vector<std::string> not_carried;  ///< columns that no topic has: "joints.csv: elbow/load"
  std::vector<std::string> remarks;      ///< what goes elsewhere than its file says, one line each
};

/// Deals the columns of a dataset folder out to the topics. Files named as above go where their
/// names say, as far as those messages have a place, so that a bag's folder becomes the same bag;
/// columns of other files, and columns out of place, go by what they are: a name is a muscle's if
/// any file has of it what only muscles have, else a joint's.
TopicTables topic_tables(const Dataset& dataset);

}  // namespace anthrob
