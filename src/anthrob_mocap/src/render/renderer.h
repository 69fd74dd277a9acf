#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "camera/stereo_rig.h"
#include "core/image.h"
#include "render/scene.h"

namespace anthrob {
namespace mocap {

struct RenderOptions {
  double background = 12.0;  ///< grey levels
  double read_noise = 1.5;   ///< standard deviation of a dark pixel [grey levels]
  double shot_noise = 0.04;  ///< variance per grey level of signal: a well of 6000 electrons
  double lens_blur = 0.6;    ///< standard deviation of the point spread, pixel included [pixel]
  std::uint64_t seed = 1;
};

/// Draws what the cameras of a rig would see of a scene: spheres in true perspective through the
/// lens's distortion (their outlines, not circles about their centres), blur, motion blur, shot and
/// read noise, clipping at 255. The same seed and frame number give the same image.
class Renderer {
 public:
  Renderer(const StereoRig& rig, const RenderOptions& options);

  /// @param instants of the exposure, evenly spaced, the middle being the stamp; one: no motion
  /// blur
  void render(Side side, const std::vector<Scene>& instants, std::uint64_t frame, Image& image);

 private:
  struct Span {
    int begin, end;
  };
  void paint(Side side, const Scene& scene);
  void paint(Side side, const Sphere& sphere);
  void add_layer(double weight);
  void develop(std::uint64_t frame, Side side, Image& image) const;

  StereoRig rig_;
  RenderOptions options_;
  std::array<std::vector<Eigen::Vector2f>, 2> rays_;  ///< ideal image point of every pixel
  std::vector<float> noise_;                          ///< standard normal
  std::vector<std::uint8_t> dark_;                    ///< background with noise
  std::vector<float> layer_, signal_;
  std::vector<Span> layer_spans_, signal_spans_;  ///< by row: what has been touched
};

}  // namespace mocap
}  // namespace anthrob
