#include "anthrob_core/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "anthrob_core/errors.h"

namespace anthrob {
FolderLock::FolderLock(const std::string& folder)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    throw std::runtime_error(folder + ": cannot be opened: " + std::strerror(errno));
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  // A network file system may know no locks of folders; then there is none.
  if (errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw BadInput(folder + ": in use by another run; expected another folder");
}

FolderLock::~FolderLock() {
  close(descriptor_);
}

}  // namespace anthrob
