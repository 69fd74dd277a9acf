#include "segmentation/segmenter.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace anthrob {
namespace mocap {

namespace {

/// A scene of markers has tens of blobs; this many specks are noise or daylight.
constexpr std::size_t kMostComponents = 20000;
constexpr int kBlock = 32;                 // pixels looked at together
constexpr double kUpperQuartile = 0.6745;  // [1] standard deviations above the median

/// Brightest of `count` pixels; compiles to vector instructions.
inline std::uint8_t brightest(const std::uint8_t* pixels, int count) {
  std::uint8_t best = 0;
  for (int i = 0; i < count; ++i) best = std::max(best, pixels[i]);
  return best;
}

/// Of a grid of pixels.
class GreyLevels {
 public:
  explicit GreyLevels(const ImageView& image) {
    for (int y = 4; y < image.height; y += 16) {
      const std::uint8_t* row = image.row(y);
      for (int x = 4; x < image.width; x += 16, ++count_) ++histogram_[row[x]];
    }
  }
  int median() const {
    int level = 0;
    for (int below = 0; level < 255 && 2 * (below += histogram_[level]) < count_;) ++level;
    return level;
  }
  /// Standard deviation of a normal distribution with this median and upper quartile. Markers are
  /// too few to move these.
  double noise() const { return (quantile(0.75) - quantile(0.5)) / kUpperQuartile; }

 private:
  /// Between levels: noise is of their size.
  double quantile(double share) const {
    const double wanted = share * count_;
    int level = 0, below = 0;
    while (level < 255 && below + histogram_[level] < wanted) below += histogram_[level++];
    return level - 0.5 + (wanted - below) / std::max(1, histogram_[level]);
  }

  int histogram_[256] = {}, count_ = 0;
};

}  // namespace

Segmenter::Segmenter(const SegmentationOptions& options) : options_(options) {
  if (options.threshold && (*options.threshold < 1 || *options.threshold > 254)) {
    throw std::invalid_argument("segmentation threshold: expected 1 to 254 grey levels");
  }
  above_.reserve(1024), current_.reserve(1024), components_.reserve(1024);
}

int Segmenter::threshold_of(const ImageView& image) const {
  const GreyLevels levels(image);
  if (options_.threshold) return std::min(254, levels.median() + *options_.threshold);
  const int wanted = static_cast<int>(std::lround(options_.noise_factor * levels.noise()));
  return std::min(
      254, levels.median() + std::clamp(wanted, options_.least_threshold, options_.most_threshold));
}

bool Segmenter::find(const ImageView& image, std::vector<Blob>& blobs) {
  blobs.clear(), components_.clear(), above_.clear();
  const int threshold = threshold_of(image);
  for (int y = 0; y < image.height; ++y) {
    if (!scan_row(image.row(y), y, image.width, threshold)) return false;
  }
  Blob blob;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    const Component& component = components_[i];
    if (component.parent == static_cast<int>(i) &&
        shape_fits(component, image.width, image.height, blob)) {
      blobs.push_back(blob);
    }
  }
  return true;
}

bool Segmenter::scan_row(const std::uint8_t* row, int y, int width, int threshold) {
  current_.clear();
  std::size_t cursor = 0;
  // Most rows of most images are dark.
  int x = brightest(row, width) > threshold ? 0 : width;
  while (x < width) {
    while (x + kBlock <= width && brightest(row + x, kBlock) <= threshold) x += kBlock;
    while (x < width && row[x] <= threshold) ++x;
    if (x == width) break;
    const int begin = x;
    std::int64_t w = 0, wx = 0;
    for (; x < width && row[x] > threshold; ++x) {
      const int weight = row[x] - threshold;
      w += weight, wx += weight * x;
    }
    const int index = component_above(begin, x, cursor);
    if (components_.size() > kMostComponents) return false;
    Component& c = components_[static_cast<std::size_t>(index)];
    const std::int64_t n = x - begin, first = begin, last = x - 1;
    const std::int64_t sum_x = n * (first + last) / 2;
    const auto squares = [](std::int64_t m) { return m * (m + 1) * (2 * m + 1) / 6; };
    c.left = std::min(c.left, begin), c.right = std::max(c.right, x - 1);
    c.top = std::min(c.top, y), c.bottom = y;
    c.area += n, c.x += sum_x, c.y += n * y;
    c.xx += squares(last) - squares(first - 1), c.xy += sum_x * y, c.yy += n * y * y;
    c.w += w, c.wx += wx, c.wy += w * y;
    current_.push_back({begin, x, index});
  }
  above_.swap(current_);
  return true;
}

/// The component of the runs above that [begin, end) touches, else a new one. `cursor` only moves
/// forward along the row above.
int Segmenter::component_above(int begin, int end, std::size_t& cursor) {
  while (cursor < above_.size() && above_[cursor].end < begin) ++cursor;
  int index = -1;
  for (std::size_t i = cursor; i < above_.size() && above_[i].begin <= end; ++i) {
    const int other = root(above_[i].component);
    index = index < 0 ? other : unite(index, other);
  }
  if (index >= 0) return index;
  Component fresh{};
  fresh.parent = index = static_cast<int>(components_.size());
  fresh.left = fresh.top = 1 << 30;
  fresh.right = fresh.bottom = -1;
  components_.push_back(fresh);
  return index;
}

int Segmenter::root(int component) {
  while (components_[static_cast<std::size_t>(component)].parent != component) {
    component = components_[static_cast<std::size_t>(component)].parent;
  }
  return component;
}

int Segmenter::unite(int a, int b) {
  if (a == b) return a;
  if (b < a) std::swap(a, b);  // the older one stays: its place in the order is its top left
  Component& into = components_[static_cast<std::size_t>(a)];
  Component& from = components_[static_cast<std::size_t>(b)];
  from.parent = a;
  into.left = std::min(into.left, from.left), into.right = std::max(into.right, from.right);
  into.top = std::min(into.top, from.top), into.bottom = std::max(into.bottom, from.bottom);
  into.area += from.area, into.x += from.x, into.y += from.y;
  into.xx += from.xx, into.xy += from.xy, into.yy += from.yy;
  into.w += from.w, into.wx += from.wx, into.wy += from.wy;
  return a;
}

bool Segmenter::shape_fits(const Component& c, int width, int height, Blob& blob) const {
  const double area = static_cast<double>(c.area);
  if (area < options_.min_area || area > options_.max_area) return false;
  if (c.left == 0 || c.top == 0 || c.right == width - 1 || c.bottom == height - 1) return false;
  const double mx = static_cast<double>(c.x) / area, my = static_cast<double>(c.y) / area;
  // A pixel is a square: its own variance of 1/12 belongs to the region's.
  const double xx = static_cast<double>(c.xx) / area - mx * mx + 1.0 / 12.0;
  const double yy = static_cast<double>(c.yy) / area - my * my + 1.0 / 12.0;
  const double xy = static_cast<double>(c.xy) / area - mx * my;
  const double mean = 0.5 * (xx + yy), half = std::hypot(0.5 * (xx - yy), xy);
  const double w = static_cast<double>(c.w);
  blob.centre = {static_cast<double>(c.wx) / w, static_cast<double>(c.wy) / w};
  blob.area = area;
  blob.axis_ratio = std::sqrt((mean + half) / std::max(1e-9, mean - half));
  blob.fill = area / (4.0 * M_PI * std::sqrt(std::max(1e-9, xx * yy - xy * xy)));
  if (area < options_.least_shape_area) return true;
  return blob.axis_ratio <= options_.max_axis_ratio && blob.fill >= options_.min_fill;
}

}  // namespace mocap
}  // namespace anthrob
