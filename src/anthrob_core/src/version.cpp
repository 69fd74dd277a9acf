#include "anthrob_core/version.h"

namespace anthrob {

std::string version_of(const std::string& program) {
  return program + " " ANTHROB_VERSION;
}

}  // namespace anthrob
