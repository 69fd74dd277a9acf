#pragma once

#include <functional>
#include <string>

#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace discovery {

/// Which columns of a recording are meant; those of commands never are.
using ColumnChoice = std::function<bool(const Column&)>;

void divide_columns(Dataset& recording, const ColumnChoice& chosen, double factor);
/// Takes `late` [s] from their stamps. They move to tables of their own.
void move_columns(Dataset& recording, const ColumnChoice& chosen, double late);
/// Undoes a filter of first order, u = y + tau y', with central differences.
void undo_filters(Dataset& recording, const ColumnChoice& chosen, double time_constant);
/// Takes `late` [s], and what has drifted [1] since the recording began, from a table's stamps.
void move_clock(Dataset& recording, const std::string& table, double late, double drift);

}  // namespace discovery
}  // namespace anthrob
