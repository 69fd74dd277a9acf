#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "segmentation/blob.h"

namespace anthrob {
namespace mocap {

struct SegmentationOptions {
  /// Grey levels above the background; none: noise_factor times the noise of each image.
  std::optional<int> threshold;
  double noise_factor = 5.0;       ///< [1] of 3e5 dark pixels 0.1 are above that by chance
  int least_threshold = 8;         ///< grey levels; above steps of a dark image without noise
  int most_threshold = 40;         ///< grey levels; an uneven background looks like noise
  double min_area = 6.0;           ///< [pixel]
  double max_area = 5000.0;        ///< [pixel]
  double max_axis_ratio = 1.4;     ///< beyond it a blob is two markers merged, or no marker
  double min_fill = 0.9;           ///< below it a blob is cut by something in front of it
  double least_shape_area = 30.0;  ///< [pixel] smaller blobs have no shape to judge
};

/// Finds bright blobs in one pass over the image: runs of pixels above the threshold, joined with
/// the runs they touch in the row above (8-neighbours), their moments summed on the way.
///
/// Centroids are weighted with the grey level above the threshold ("linear threshold"): a pixel at
/// the edge enters with weight zero, so noise there does not make the centroid jump, as it does
/// with the binary threshold of (A.3.2); see the standard deviations of Table A.1.
/// The background is the median of a grid of pixels, its noise what their upper quartile says: the
/// lower one is cut off where the camera's black is 0.
class Segmenter {
 public:
  explicit Segmenter(const SegmentationOptions& options);

  /// @param blobs replaced; from top to bottom, left to right. Blobs at the border are dropped:
  ///   their centroid would be off.
  /// @return false if the image has more bright specks than a scene of markers can have; `blobs` is
  ///   then empty
  bool find(const ImageView& image, std::vector<Blob>& blobs);

 private:
  struct Run {
    int begin, end, component;
  };
  struct Component {
    int parent;
    int left, right, top, bottom;
    std::int64_t area, x, y, xx, xy, yy;  ///< sums over pixels
    std::int64_t w, wx, wy;               ///< weighted sums
  };

  int threshold_of(const ImageView& image) const;
  bool scan_row(const std::uint8_t* row, int y, int width, int threshold);
  int component_above(int begin, int end, std::size_t& cursor);
  int root(int component);
  int unite(int a, int b);
  bool shape_fits(const Component& component, int width, int height, Blob& blob) const;

  SegmentationOptions options_;
  std::vector<Run> above_, current_;
  std::vector<Component> components_;
};

}  // namespace mocap
}  // namespace anthrob
