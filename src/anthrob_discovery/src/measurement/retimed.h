#pragma once

#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace discovery {

/// When the values of a table's rows were taken; nothing: the row does not count.
using TimesTaken = std::vector<std::optional<Nanoseconds>>;

/// Gives columns of a table other times. The columns move to a table of their own, unless nothing
/// else was measured in theirs. Rows that would lie outside of the recording are left out, so that
/// all other times stay what they are.
/// @param name of the new table   @param times by row, rising
void retime(Dataset& recording, const std::string& table, const std::vector<std::string>& columns,
            const std::string& name, const TimesTaken& times);

}  // namespace discovery
}  // namespace anthrob
