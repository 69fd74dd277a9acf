#pragma once

#include <fstream>
#include <string>

namespace anthrob {

/// What to put before a command so that it is interrupted (SIGINT) when a file has something in it.
/// @param script written for that
inline std::string interrupted_when(const std::string& file, const std::string& script) {
  std::ofstream(script) << "\"$@\" & pid=$!\n"
                        << "while kill -0 $pid && [ ! -s " << file << " ]; do sleep 0.002; done\n"
                        << "kill -INT $pid; wait $pid\n";
  return "bash " + script + " ";
}

}  // namespace anthrob
