#pragma once

#include <string>

namespace anthrob {
namespace discovery {

inline const std::string kConfig = ANTHROB_CONFIG_DIR;

}  // namespace discovery
}  // namespace anthrob
