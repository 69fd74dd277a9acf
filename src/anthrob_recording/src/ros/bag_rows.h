#pragma once

#include <anthrob_msgs/ExternalWrenches.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/SphericalJointStates.h>
#include <sensor_msgs/JointState.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_recording/table.h"
#include "dataset/topic_rows.h"

namespace anthrob {

/// Whose values a message holds, as columns are called. Further pushes of the same link are LINK:2
/// and so on.
template <class Message>
const std::vector<std::string>& owners_of(const Message& message) {
  return message.name;
}
std::vector<std::string> owners_of(const anthrob_msgs::ExternalWrenches& message);

/// Appends what a message puts into a row.
/// @return false if its lists differ in length; the cells are then incomplete
bool to_cells(const anthrob_msgs::MuscleCommand& m, Cells& cells);
bool to_cells(const anthrob_msgs::MuscleStates& m, Cells& cells);
bool to_cells(const sensor_msgs::JointState& m, Cells& cells);
bool to_cells(const anthrob_msgs::SphericalJointStates& m, Cells& cells);
bool to_cells(const anthrob_msgs::ExternalWrenches& m, Cells& cells);

/// Fills a message, except for its header, from a row of a table.
/// @throws BadInput if a quantity is given for some names only, or if an orientation, an angular
/// velocity or a command is incomplete
void from_row(const Table& table, std::size_t index, anthrob_msgs::MuscleCommand& m);
void from_row(const Table& table, std::size_t index, anthrob_msgs::MuscleStates& m);
void from_row(const Table& table, std::size_t index, sensor_msgs::JointState& m);
void from_row(const Table& table, std::size_t index, anthrob_msgs::SphericalJointStates& m);
/// What a push lacks is zero; for how long it goes on is not known.
void from_row(const Table& table, std::size_t index, anthrob_msgs::ExternalWrenches& m);

}  // namespace anthrob
