#include "anthrob_sim/recording/atomic_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace anthrob {

void write_file_atomically(const std::string& file, const std::string& content) {
  const std::string temporary = file + ".part" + std::to_string(getpid());
  {
    std::ofstream out(temporary, std::ios::binary);
    out << content;
    out.close();
    if (!out) {
      const std::string reason = std::strerror(errno);
      std::filesystem::remove(temporary);
      throw std::runtime_error(file + ": cannot be written: " + reason);
    }
  }
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) {
    std::filesystem::remove(temporary);
    throw std::runtime_error(file + ": cannot be written: " + error.message());
  }
}

}  // namespace anthrob
