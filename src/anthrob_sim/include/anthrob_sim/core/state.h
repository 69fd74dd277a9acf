#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace anthrob {

/// A component's own stretch of the simulation's state.
/// Components hold parameters only; everything that changes while stepping lives in one contiguous
/// array of doubles, so that a snapshot is a copy of that array.
class StateView {
 public:
  explicit StateView(double* data = nullptr) : data_(data) {}

  double& operator[](std::size_t i) const { return data_[i]; }
  double* data() const { return data_; }
  StateView from(std::size_t offset) const { return StateView(data_ + offset); }

  /// The stretch seen as a struct of doubles.
  template <class T>
  T& as() const {
    static_assert(std::is_trivially_copyable<T>::value, "state is copied as raw memory");
    static_assert(alignof(T) == alignof(double) && sizeof(T) % sizeof(double) == 0,
                  "state is made of doubles");
    return *reinterpret_cast<T*>(data_);
  }

 private:
  double* data_;
};

template <class T>
constexpr std::size_t state_size_of() {
  return sizeof(T) / sizeof(double);
}

/// Grows while the simulation is built; fixed in size afterwards.
class StateStore {
 public:
  /// @return offset of `size` new doubles
  std::size_t reserve(std::size_t size) {
    const std::size_t offset = data_.size();
    data_.resize(offset + size, 0.0);
    return offset;
  }
  StateView at(std::size_t offset) { return StateView(data_.data() + offset); }
  const std::vector<double>& data() const { return data_; }
  void assign(const std::vector<double>& data) {
    std::copy(data.begin(), data.end(), data_.begin());
  }

 private:
  std::vector<double> data_;
};

}  // namespace anthrob
