#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {

/// "joint_states" of "/anthrob/joint_states"
std::string leaf_of_topic(const std::string& topic);

/// Whether a topic is one of those that a recording has, in whatever namespace.
bool is_of_a_recording(const std::string& topic);

/// A topic of a recording, its table, and under which names a bag has it.
struct RecordedTopic {
  std::string leaf;   ///< "muscle_states"
  std::string table;  ///< "muscles"
  std::vector<std::string> topics;
};

/// Chooses the topics of a robot among those of a bag, in the order of a recording's tables. The
/// robot is the namespace they are in, or what the description beside the bag says.
/// @param counts messages by topic   @param file the bag   @param beside NAME.yaml of the bag
/// @param dataset gets meta and remarks   @param not_carried gets the other topics
/// @throws BadInput if there is no such topic, or if there are several robots
std::vector<RecordedTopic> choose_topics(const std::map<std::string, std::uint64_t>& counts,
                                         const std::string& file, const std::string& beside,
                                         Dataset& dataset, std::vector<std::string>& not_carried);

}  // namespace anthrob
