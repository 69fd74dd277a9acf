#include "anthrob_core/programs.h"

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace anthrob {

namespace fs = std::filesystem;

std::string program_of_package(const std::string& package, const std::string& name) {
  const fs::path beside = fs::path(package) / name;
  std::error_code error;
  const fs::path own = fs::read_symlink("/proc/self/exe", error);
  std::vector<fs::path> places = {own.parent_path().parent_path() / beside};
  const char* const spaces = std::getenv("CMAKE_PREFIX_PATH");
  std::istringstream list(spaces ? spaces : "");
  for (std::string space; std::getline(list, space, ':');) {
    places.push_back(fs::path(space) / "lib" / beside);
  }
  for (const fs::path& place : places) {
    if (fs::exists(place, error)) return place.string();
  }
  throw std::runtime_error(name + ": not found; expected " + places.front().string() +
                           ", or a workspace whose setup.bash was sourced");
}

}  // namespace anthrob
