#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// A recording, split by the topics that it is written to.
struct TopicTables {
  /// Named commands, muscles, joints, spherical_joints or wrenches; several may have one name. A
  /// row without any cell is a message without names.
  std::vector<Table> tables;
  std::vector<std::string> not_carried;  ///< columns that no topic has: "joints.csv: elbow/load"
  std::vector<std::string> remarks;      ///< columns for another topic than their file's, one each
};

/// Assigns the columns of a dataset folder to topics. Columns of files named as above go to the
/// topic of that name if its messages have a field for them; so a folder made from a bag becomes
/// the same bag again. All other columns are assigned by their quantity: a name counts as a muscle
/// if any file has a quantity of it that only muscles have, else as a joint.
TopicTables topic_tables(const Dataset& dataset);

}  // namespace anthrob
