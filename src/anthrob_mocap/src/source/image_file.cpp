#include "source/image_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <sstream>

#include "anthrob_core/errors.h"

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

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 |
         std::uint32_t{bytes[2]} << 8 | std::uint32_t{bytes[3]};
}

/// The checksum of PNG chunks (ISO 3309).
std::uint32_t crc32(const std::uint8_t* begin, const std::uint8_t* end) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? 0xedb88320u ^ (c >> 1) : c >> 1;
      table[n] = c;
    }
    return table;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (; begin != end; ++begin) crc = kTable[(crc ^ *begin) & 0xff] ^ (crc >> 8);
  return ~crc;
}

/// Why a PNG cannot be whole; none if its chunks are, from the first to IEND.
std::optional<std::string> damage_of_png(const Bytes& bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // length, type and checksum of a chunk
  for (std::size_t at = kSignature; at + kFrame <= bytes.size();) {
    const std::uint8_t* chunk = &bytes[at];
    const std::size_t length = big_endian(chunk);
    if (length > bytes.size() - at - kFrame) break;
    const std::uint8_t *type = chunk + 4, *checksum = type + 4 + length;
    if (crc32(type, checksum) != big_endian(checksum)) return "damaged image: wrong checksum";
    if (std::equal(type, type + 4, "IEND")) return std::nullopt;
    at += kFrame + length;
  }
  return "truncated image";
}

/// Why the bytes cannot be a whole image; none if nothing speaks against it. The decoders fill
/// what is missing with grey, or print lines of their own on standard error.
std::optional<std::string> damage_of(const Bytes& bytes) {
  const auto begins = [&](const Bytes& mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
  };
  const auto holds_near_end = [&](const Bytes& mark) {
    const std::size_t tail = std::min<std::size_t>(bytes.size(), 64);
    return std::search(bytes.end() - static_cast<std::ptrdiff_t>(tail), bytes.end(), mark.begin(),
                       mark.end()) != bytes.end();
  };
  if (begins({0x89, 'P', 'N', 'G'})) return damage_of_png(bytes);
  const bool truncated = (begins({0xff, 0xd8}) && !holds_near_end({0xff, 0xd9})) ||
                         (begins({'P', '5'}) && truncated_pgm(bytes));
  if (!truncated) return std::nullopt;
  return "truncated image";
}

cv::Mat decode(const std::string& file, int flags) {
  const Bytes bytes = read_bytes(file);
  if (bytes.empty()) throw BadInput(file + ": the file is empty");
  if (const auto damage = damage_of(bytes)) throw BadInput(file + ": " + *damage);
  cv::Mat image;
  try {
    image = cv::imdecode(bytes, flags);
  } catch (const cv::Exception&) {
    // Reported below, as an empty image.
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

std::optional<std::string> image_number(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  const auto end = stem.find_last_of("0123456789");
  if (end == std::string::npos) return std::nullopt;
  const auto before = stem.find_last_not_of("0123456789", end);
  const auto begin = before == std::string::npos ? 0 : before + 1;
  // Decimals, as in a stamp "1700000000.25", do not count images.
  const bool is_decimals = begin >= 2 && stem[begin - 1] == '.' &&
                           std::isdigit(static_cast<unsigned char>(stem[begin - 2]));
  if (is_decimals) return std::nullopt;
  return stem.substr(begin, end + 1 - begin);
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
