#pragma once

#include <string>
#include <vector>

#include "identification/ring_identification.h"

namespace anthrob {
namespace identification {

/// What is odd about a fitted ring, one line each: a zero of the expansion beyond what a calliper
/// errs by, a modulus that falls with the strain.
std::vector<std::string> remarks_on(const RingResult& ring);

}  // namespace identification
}  // namespace anthrob
