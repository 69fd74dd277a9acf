#pragma once

#include <optional>
#include <vector>

#include "admission/clock_offsets.h"
#include "measurement/description.h"

namespace anthrob {
namespace discovery {

/// Whether nothing but joints is in a table.
bool is_of_joints(const RobotModel& robot, const Table& table);

/// A table whose stamps were moved by a whole clock's offset.
struct MovedTable {
  std::size_t recording;  ///< of recordings_of()
  ClockOffset offset;
};

/// Moves tables of joints that were stamped by another clock than the muscles, by whole movements
/// (clock_offsets). Of few movements it is only told.
/// @param is_last whether nobody looks again
/// @param moved gets what was moved; of a table that was moved before, both together
void correct_clock_offsets(const RobotModel& robot, bool is_last, std::vector<MovedTable>& moved,
                           Description& description);

/// The same by what the given model does: what is left of these offsets, and clocks that drift.
/// Reports both.
/// @param simulated replays() of all recordings: train, test, repeats
void correct_clocks(const RobotModel& robot, const std::vector<std::optional<Dataset>>& simulated,
                    const std::vector<MovedTable>& moved, Description& description);

}  // namespace discovery
}  // namespace anthrob
