#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace anthrob {

/// All of a file; nothing if there is none.
inline std::string content(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(in), {});
}

}  // namespace anthrob
