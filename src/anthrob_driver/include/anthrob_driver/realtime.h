#pragma once

#include <optional>
#include <string>

namespace anthrob {
namespace driver {

/// Gives the calling thread SCHED_FIFO with `priority` and locks the process's memory.
/// @return what the system refused, if it refused anything
std::optional<std::string> become_realtime(int priority);

}  // namespace driver
}  // namespace anthrob
