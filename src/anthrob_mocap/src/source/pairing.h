#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "core/image.h"
#include "core/types.h"

namespace anthrob {
namespace mocap {

/// One camera's image and the time of its exposure.
struct TimedImage {
  double t = 0.0;       ///< [s], resolves only 119 ns today
  std::int64_t ns = 0;  ///< the same, exact [ns]
  ImageView image;
  std::shared_ptr<const void> owner;
};

/// Pairs images of two cameras by their stamps. The image that arrives first waits for its partner;
/// an image without a partner is dropped and counted.
class Pairing {
 public:
  /// @param tolerance [s] between the stamps of a pair; 0: they must be equal
  explicit Pairing(double tolerance) : tolerance_(tolerance) {}

  /// @return true if the image completes a pair, then in pair[kLeft], pair[kRight]
  /// @throws BadInput if its stamp is not later than the previous one of this side: images with
  ///   equal stamps cannot be paired. A step back by a second or more starts over (a bag that
  ///   loops, a restarted simulator), and so do some refused stamps in a row that increase.
  bool add(Side side, const TimedImage& image, TimedImage pair[2]);

  struct Counts {
    int images[2] = {0, 0};
    int pairs = 0;
    int lost = 0;          ///< images of either side without a partner, or not taken in time
    double nearest = 0.0;  ///< [s] right minus left stamp of the nearest that did not pair
  };
  /// Since the last call.
  Counts take_counts();
  /// To be called after the last image: counts those that still wait as lost.
  void end();
  /// Why there are images but no pairs, or none of one camera; none if all is well.
  static std::optional<std::string> complaint(const Counts& counts, double tolerance);
  /// How many images were lost, as text, if that is more than one in twenty.
  static std::optional<std::string> loss(const Counts& counts);
  /// [s] as given, but at most half the period of a camera, once that is known: with a wider one,
  /// images one period apart would form pairs from then on.
  double tolerance() const;
  /// [s] period of the cameras: median of the last intervals between images; 0: not known yet.
  double period() const;

 private:
  void advance(Side side, double t);
  void lose(Side side, std::size_t count);

  double tolerance_;
  std::optional<double> last_[2];     ///< [s] stamps
  std::optional<double> refused_[2];  ///< [s] the last stamp, if it was refused
  int advancing_[2] = {0, 0};         ///< refused stamps in a row, each after the one before
  std::deque<double> intervals_;      ///< [s] the last between images of either side
  std::deque<TimedImage> waiting_[2];
  Counts counts_;
};

}  // namespace mocap
}  // namespace anthrob
