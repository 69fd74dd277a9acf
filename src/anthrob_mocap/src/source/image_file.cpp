#include "anthrob_mocap/source/image_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace mocap {

namespace fs = std::filesystem;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes read_bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in || fs::is_directory(file)) throw BadInput(file + ": cannot be read");
  return Bytes(std::istreambuf_iterator<char>(in), {});
}

/// Whether a binary PGM ends before what its header promises.
bool truncated_pgm(const Bytes& bytes) {
  std::istringstream in(std::string(bytes.begin(), bytes.end()));
  std::size_t numbers[3] = {0, 0, 0};  // width, height, white
  in.ignore(2);
  for (std::size_t& number : numbers) {
    while ((in >> std::ws).peek() == '#') in.ignore(std::numeric_limits<int>::max(), '\n');
    if (!(in >> number) || number > 65535) return in.eof();
  }
  if (in.eof()) return true;
  const auto header = static_cast<std::size_t>(in.tellg()) + 1;
  return bytes.size() < header + numbers[0] * numbers[1] * (numbers[2] > 255 ? 2 : 1);
}

/// The decoders fill what is missing with grey, or chatter on standard error.
bool truncated(const Bytes& bytes) {
  const auto begins = [&](const Bytes& mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
  };
  const auto holds_near_end = [&](const Bytes& mark) {
    const std::size_t tail = std::min<std::size_t>(bytes.size(), 64);
    return std::search(bytes.end() - static_cast<std::ptrdiff_t>(tail), bytes.end(), mark.begin(),
                       mark.end()) != bytes.end();
  };
  if (begins({0x89, 'P', 'N', 'G'})) return !holds_near_end({'I', 'E', 'N', 'D'});
  if (begins({0xff, 0xd8})) return !holds_near_end({0xff, 0xd9});
  if (begins({'P', '5'})) return truncated_pgm(bytes);
  return false;
}

cv::Mat decode(const std::string& file, int flags) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) throw BadInput(file + ": the file is empty");
  if (truncated(bytes)) throw BadInput(file + ": truncated image");
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, flags);
  } catch (const cv::Exception&) {
    // Said below.
  }
  if (image.empty()) throw BadInput(file + ": not an image that can be decoded");
  return image;
}

Image copy(const cv::Mat& grey) {
  Image image;
  image.resize(grey.cols, grey.rows);
  for (int y = 0; y < grey.rows; ++y) std::copy_n(grey.ptr(y), grey.cols, image.row(y));
  return image;
}

}  // namespace

Image read_grey_image(const std::string& file) {
  const cv::Mat image = decode(file, cv::IMREAD_UNCHANGED);
  if (image.channels() != 1 || image.depth() != CV_8U) {
    throw BadInput(file + ": " + std::to_string(8 * image.elemSize1()) + "-bit image of " +
                   std::to_string(image.channels()) + " channel(s): expected 8-bit grey");
  }
  return copy(image);
}

Image read_any_image(const std::string& file) {
  return copy(decode(file, cv::IMREAD_GRAYSCALE));
}

void write_grey_image(const std::string& file, const Image& image) {
  const cv::Mat view(image.height, image.width, CV_8U,
                     const_cast<std::uint8_t*>(image.pixels.data()));
  if (!cv::imwrite(file, view)) throw std::runtime_error(file + ": cannot be written");
}

std::vector<std::string> list_images(const std::string& folder) {
  if (!fs::is_directory(folder)) throw BadInput(folder + ": no such folder");
  static const std::set<std::string> kExtensions{".png", ".pgm",  ".jpg", ".jpeg",
                                                 ".tif", ".tiff", ".bmp"};
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (kExtensions.count(extension)) names.push_back(entry.path().filename().string());
  }
  if (names.empty()) throw BadInput(folder + ": holds no image");
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace mocap
}  // namespace anthrob
