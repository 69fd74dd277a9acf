#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace anthrob {

/// What to put before a command so that it is interrupted (SIGINT) when a file has something in it.
/// @param script written for that
inline std::string interrupted_when(const std::string& file, const std::string& script) {
  std::filesystem::remove(script + ".sent");
  std::ofstream(script) << "\"$@\" & pid=$!\n"
                        << "while kill -0 $pid && [ ! -s " << file << " ]; do sleep 0.002; done\n"
                        << "kill -INT $pid && touch " << script << ".sent; wait $pid\n";
  return "bash " + script + " ";
}

/// Whether the command of a script was still there to be interrupted. One that was not ends with 0;
/// so does one that does not care.
inline bool interrupt_was_sent(const std::string& script) {
  return std::filesystem::exists(script + ".sent");
}

}  // namespace anthrob
