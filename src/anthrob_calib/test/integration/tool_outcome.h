#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace anthrob {
namespace testing_support {

inline std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Of a tool that ran.
struct Outcome {
  int status;
  std::string errors;  ///< what it wrote to its standard error

  long lines() const { return std::count(errors.begin(), errors.end(), '\n'); }
};

}  // namespace testing_support
}  // namespace anthrob
