#pragma once

#include <functional>
#include <string>
#include <vector>

namespace anthrob {
namespace fuzz {

/// A kind of file, and the function that reads it.
struct Reader {
  std::string name;
  std::string file;                ///< that it reads, in the folder of the work
  std::vector<std::string> sound;  ///< whole files to damage
  std::function<void()> read;      ///< throws an exception of one line where the file is refused
};

/// Makes the files in `work` that are read beside the damaged ones.
/// @param config folder of the same name of this suite
std::vector<Reader> all_readers(const std::string& config, const std::string& work);

}  // namespace fuzz
}  // namespace anthrob
