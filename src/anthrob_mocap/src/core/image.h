#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace anthrob {
namespace mocap {

/// 8-bit grey pixels that belong to somebody else. The centre of the first pixel is (0, 0).
struct ImageView {
  const std::uint8_t* pixels = nullptr;
  int width = 0;
  int height = 0;
  std::size_t stride = 0;  ///< bytes from row to row

  const std::uint8_t* row(int y) const { return pixels + static_cast<std::size_t>(y) * stride; }
};

/// An 8-bit grey image, rows without padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;

  void resize(int new_width, int new_height) {
    width = new_width, height = new_height;
    pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
  std::uint8_t* row(int y) { return pixels.data() + static_cast<std::size_t>(y) * width; }
  const std::uint8_t* row(int y) const {
    return pixels.data() + static_cast<std::size_t>(y) * width;
  }
  ImageView view() const { return {pixels.data(), width, height, static_cast<std::size_t>(width)}; }
};

}  // namespace mocap
}  // namespace anthrob
