#pragma once

#include <filesystem>
#include <string>

#include "anthrob_recording/table.h"

namespace anthrob {

/// A CSV file of a dataset folder.  @throws BadInput with file, line, value and what was expected
Table read_table(const std::filesystem::path& file);

/// Checks that a file begins like a table of a recording.  @throws BadInput if it does not
void require_table_header(const std::filesystem::path& file);

/// The text of a table's file.
std::string table_text(const Table& table);

}  // namespace anthrob
