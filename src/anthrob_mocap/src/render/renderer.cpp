#include "render/renderer.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "anthrob_core/random.h"

namespace anthrob {
namespace mocap {

namespace {

// Noise is read from a table at an offset that differs from row to row and frame to frame: a
// generator per pixel would cost more than all the rest.
constexpr std::size_t kNoiseTable = 1 << 18;

std::uint64_t hash(std::uint64_t x) {
  return split_mix(x + 0x9e3779b97f4a7c15ULL);
}

std::uint8_t clip(double grey) {
  return static_cast<std::uint8_t>(std::lround(std::min(255.0, std::max(0.0, grey))));
}

}  // namespace

Renderer::Renderer(const StereoRig& rig, const RenderOptions& options)
    : rig_(rig), options_(options) {
  const int width = rig.width(), height = rig.height();
  for (const Side side : {kLeft, kRight}) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        rays_[side].push_back(rig.camera(side).ideal({x, y}).cast<float>());
      }
    }
  }
  std::mt19937_64 generator(options.seed);
  std::normal_distribution<float> normal;
  for (std::size_t i = 0; i < kNoiseTable + static_cast<std::size_t>(width); ++i) {
    noise_.push_back(normal(generator));
    dark_.push_back(clip(options.background + options.read_noise * noise_.back()));
  }
  const std::size_t pixels = rays_[0].size();
  layer_.assign(pixels, 0.0f), signal_.assign(pixels, 0.0f);
  layer_spans_.assign(static_cast<std::size_t>(height), {width, 0});
  signal_spans_ = layer_spans_;
}

void Renderer::render(Side side, const std::vector<Scene>& instants, std::uint64_t frame,
                      Image& image) {
  for (const Scene& scene : instants) {
    paint(side, scene);
    add_layer(1.0 / static_cast<double>(instants.size()));
  }
  develop(frame, side, image);
  for (std::size_t y = 0; y < signal_spans_.size(); ++y) {
    Span& span = signal_spans_[y];
    float* row = &signal_[y * static_cast<std::size_t>(rig_.width())];
    if (span.begin < span.end) std::fill(row + span.begin, row + span.end, 0.0f);
    span = {rig_.width(), 0};
  }
}

void Renderer::paint(Side side, const Scene& scene) {
  // From far to near: what is nearer covers what is behind it.
  std::vector<const Sphere*> order;
  for (const Sphere& sphere : scene.spheres) order.push_back(&sphere);
  std::stable_sort(order.begin(), order.end(), [&](const Sphere* a, const Sphere* b) {
    return rig_.in_camera(side, a->p).norm() > rig_.in_camera(side, b->p).norm();
  });
  for (const Sphere* sphere : order) paint(side, *sphere);
}

void Renderer::paint(Side side, const Sphere& sphere) {
  const CameraModel& camera = rig_.camera(side);
  const Vec3 p = rig_.in_camera(side, sphere.p);
  if (p.z() < 4.0 * sphere.radius) return;
  const Vec2 ideal(p.x() / p.z(), p.y() / p.z());
  const Vec2 distorted = camera.distort(ideal);
  // Beyond the fold of the lens polynomial nothing is seen, though the polynomial has a value.
  if (ideal.norm() > 1.5 || !((camera.undistort(distorted) - ideal).norm() < 1e-6)) return;
  const Vec2 centre = camera.project(p);
  const double focal = std::sqrt(camera.fx * camera.fy);
  const double reach = 1.5 * focal * sphere.radius / p.z() + 5.0 * options_.lens_blur + 1.0;
  const int x0 = std::max(0, static_cast<int>(std::floor(centre.x() - reach)));
  const int x1 = std::min(rig_.width(), static_cast<int>(std::ceil(centre.x() + reach)) + 1);
  const int y0 = std::max(0, static_cast<int>(std::floor(centre.y() - reach)));
  const int y1 = std::min(rig_.height(), static_cast<int>(std::ceil(centre.y() + reach)) + 1);
  const Vec3 axis = p.normalized();
  const double sine = sphere.radius / p.norm();
  const double scale = focal / (options_.lens_blur * std::sqrt(2.0));
  for (int y = y0; y < y1 && x0 < x1; ++y) {
    Span& span = layer_spans_[static_cast<std::size_t>(y)];
    span.begin = std::min(span.begin, x0), span.end = std::max(span.end, x1);
    for (int x = x0; x < x1; ++x) {
      const std::size_t pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(rig_.width()) +
          static_cast<std::size_t>(x);
      const Vec3 ray(rays_[side][pixel].x(), rays_[side][pixel].y(), 1.0);
      // The outline is where the ray touches the sphere; blur smears the step over it.
      const double outside = ray.cross(axis).norm() / ray.norm() - sine;
      if (!(outside < 5.0 * options_.lens_blur / focal)) continue;
      const double cover = 0.5 * std::erfc(outside * scale);
      layer_[pixel] += static_cast<float>(cover * (sphere.brightness - layer_[pixel]));
    }
  }
}

void Renderer::add_layer(double weight) {
  for (std::size_t y = 0; y < layer_spans_.size(); ++y) {
    Span &span = layer_spans_[y], &into = signal_spans_[y];
    if (span.begin >= span.end) continue;
    const std::size_t row = y * static_cast<std::size_t>(rig_.width());
    for (int x = span.begin; x < span.end; ++x) {
      const std::size_t pixel = row + static_cast<std::size_t>(x);
      signal_[pixel] += static_cast<float>(weight) * layer_[pixel];
      layer_[pixel] = 0.0f;
    }
    into.begin = std::min(into.begin, span.begin), into.end = std::max(into.end, span.end);
    span = {rig_.width(), 0};
  }
}

void Renderer::develop(std::uint64_t frame, Side side, Image& image) const {
  image.resize(rig_.width(), rig_.height());
  for (int y = 0; y < image.height; ++y) {
    const std::uint64_t place = (frame * 2 + side) * 65536 + static_cast<std::uint64_t>(y);
    const std::size_t offset = hash(options_.seed ^ hash(place)) % kNoiseTable;
    std::uint8_t* row = image.row(y);
    std::copy_n(&dark_[offset], image.width, row);
    const Span& span = signal_spans_[static_cast<std::size_t>(y)];
    const float* signal =
        &signal_[static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width)];
    for (int x = span.begin; x < span.end; ++x) {
      if (signal[x] <= 0.0f) continue;
      const double sigma =
          std::sqrt(options_.read_noise * options_.read_noise + options_.shot_noise * signal[x]);
      row[x] = clip(options_.background + signal[x] +
                    sigma * noise_[offset + static_cast<std::size_t>(x)]);
    }
  }
}

}  // namespace mocap
}  // namespace anthrob
