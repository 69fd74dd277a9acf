#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "scope/samples.h"

namespace anthrob {

/// One column of a CSV file.
struct CsvColumn {
  std::string name;
  SampleSpan samples;
  Nanoseconds origin = 0;  ///< subtracted from its times
};

/// Writes all samples, one row for each time, with an empty cell where a column has none then. A
/// time that a column has twice gets two rows. No digit is lost: each number reads back as the
/// same double, times are exact to the nanosecond.
void write_csv(const std::string& time_name, const std::vector<CsvColumn>& columns,
               std::ostream& out);

}  // namespace anthrob
