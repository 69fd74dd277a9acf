#pragma once

#include <stdexcept>

namespace anthrob {
namespace mocap {

/// Input that cannot be used; what() is one line: file, line, key, value, what was expected.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mocap
}  // namespace anthrob
