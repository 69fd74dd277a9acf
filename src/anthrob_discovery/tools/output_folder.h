#pragma once

#include <map>
#include <string>
#include <vector>

#include "options/loop.h"

namespace anthrob {
namespace discovery {

/// Removes recordings of an earlier loop from a folder. @param made names of the recordings of this
/// loop, which stay
void remove_other_recordings(const std::string& folder, const std::vector<std::string>& made,
                             const LoopOptions& options);

/// Removes protocols of an earlier answer from the folder.
/// @param files files of this answer by name, which stay
void remove_other_protocols(const std::string& folder,
                            const std::map<std::string, std::string>& files);

}  // namespace discovery
}  // namespace anthrob
