#include "allocations.h"

#include <cstdlib>

namespace {
std::size_t count = 0;
}

// Of glibc. NOLINTNEXTLINE(bugprone-reserved-identifier)
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t size) noexcept {
  ++count;
  return __libc_malloc(size);
}

namespace anthrob {
namespace testing_support {

std::size_t allocations() {
  return count;
}

}  // namespace testing_support
}  // namespace anthrob
