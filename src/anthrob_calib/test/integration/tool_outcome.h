#pragma once

#include <algorithm>
#include <string>

namespace anthrob {
namespace testing_support {

/// Of a tool that ran.
struct Outcome {
  int status;
  std::string errors;  ///< what it wrote to its standard error

  long lines() const { return std::count(errors.begin(), errors.end(), '\n'); }
};

}  // namespace testing_support
}  // namespace anthrob
