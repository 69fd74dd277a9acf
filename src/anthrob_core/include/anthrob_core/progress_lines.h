#pragma once

#include <optional>
#include <string>

namespace anthrob {
namespace tool {

/// How far a program is, for the program that started it: each call writes one line of JSON with
/// the keys named here to the file descriptor in the environment variable ANTHROB_PROGRESS_FD.
/// Without that variable nothing is written. A reader who is gone changes nothing for the program.
namespace progress_lines {

constexpr const char* kVariable = "ANTHROB_PROGRESS_FD";

/// {"stage": ...}: what is done now.
void stage(const std::string& what);
/// {"share": ..., "seconds_left": ...}: of all that the program does, 0 to 1.
/// @param seconds_left [s]; none: not known, null
void share(double share, std::optional<double> seconds_left);
/// {"best": ...}: the best that was found so far.
void best(const std::string& what);
/// {"headline": ...}: the result in one line.
void headline(const std::string& line);
/// {"error": ...}: why the program ends without a result.
void error(const std::string& line);

}  // namespace progress_lines
}  // namespace tool
}  // namespace anthrob
