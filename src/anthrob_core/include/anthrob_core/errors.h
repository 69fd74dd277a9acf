#pragma once

#include <stdexcept>

namespace anthrob {

/// Input that cannot be used; what() is one line: file, line, key, value, what was expected.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace anthrob
