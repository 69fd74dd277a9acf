#pragma once

namespace anthrob {
namespace discovery {

/// A number above 0 and not above 1. It is written and read as a number.
// NOLINTBEGIN(google-explicit-constructor)
struct Share {
  constexpr Share(double number) : value(number) {}
  constexpr operator double() const { return value; }
  double value;
};
// NOLINTEND(google-explicit-constructor)

}  // namespace discovery
}  // namespace anthrob
