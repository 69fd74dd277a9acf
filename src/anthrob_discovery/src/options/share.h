#pragma once

namespace anthrob {
namespace discovery {

/// A number above 0 and not above 1.
struct Share {
  constexpr Share(double number) : value(number) {}
  constexpr operator double() const { return value; }
  double value;
};

}  // namespace discovery
}  // namespace anthrob
