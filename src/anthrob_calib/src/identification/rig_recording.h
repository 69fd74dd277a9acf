#pragma once

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "anthrob_core/config_node.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace identification {

/// Columns of one table of a recording, all measured in every row and finite.
struct RigColumns {
  std::vector<double> t;                    ///< [s] since the start, growing
  std::vector<std::vector<double>> values;  ///< one list a column asked for

  /// Median time between rows [s].
  double period() const;
};

/// @param rig what kind of recording is expected, for messages
/// @throws BadInput with one line: file, line, column, value, what was expected
RigColumns read_columns(const Dataset& recording, const std::string& rig,
                        const std::vector<std::string>& names);

/// meta.yaml of a recording, which states what was on the rig.
/// @throws BadInput for a bag, which has no such keys
ConfigNode rig_meta(const Dataset& recording);

/// Name of a recording in messages and reports.
std::string recording_name(const Dataset& recording);

/// By specimen and name, so that the order in which recordings are given does not matter.
template <class Recording>
void sort_by_specimen(std::vector<Recording>& recordings) {
  std::stable_sort(recordings.begin(), recordings.end(), [](const auto& a, const auto& b) {
    return std::tie(a.specimen, a.name) < std::tie(b.specimen, b.name);
  });
}

}  // namespace identification
}  // namespace anthrob
