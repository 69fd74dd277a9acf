#pragma once

#include <cstddef>

namespace anthrob {
namespace testing_support {

/// Allocations so far, of this test program and of the libraries it calls.
std::size_t allocations();

}  // namespace testing_support
}  // namespace anthrob
