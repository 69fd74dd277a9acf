#include "source/aravis_source.h"

#include <arv.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

#include "anthrob_core/errors.h"
#include "source/live_pair.h"

namespace anthrob {
namespace mocap {

namespace {

using namespace std::chrono_literals;

constexpr int kBuffers = 8;

/// What aravis reports, as an exception.
class Check {
 public:
  ~Check() { g_clear_error(&error_); }
  operator GError**() { return &error_; }  // NOLINT: passed where aravis wants its GError**
  void raise() {
    if (!error_) return;
    const std::string what = error_->message;
    g_clear_error(&error_);
    throw std::runtime_error(what);
  }

 private:
  GError* error_ = nullptr;
};

/// One open camera that streams.
class Camera {
 public:
  Camera(const CameraOptions& options, Side side) {
    Check check;
    camera_.reset(arv_camera_new(options.name[side].c_str(), check));
    check.raise();
    configure(options);
    stream_.reset(arv_camera_create_stream(camera_.get(), nullptr, nullptr, check));
    check.raise();
    const std::size_t payload = arv_camera_get_payload(camera_.get(), check);
    check.raise();
    for (int i = 0; i < kBuffers; ++i) {
      arv_stream_push_buffer(stream_.get(), arv_buffer_new(payload, nullptr));
    }
    arv_camera_start_acquisition(camera_.get(), check);
    check.raise();
  }
  ~Camera() {
    Check check;  // a camera that is gone cannot be stopped: nothing to do about it
    arv_camera_stop_acquisition(camera_.get(), check);
  }

  void trigger() {
    Check check;
    arv_camera_software_trigger(camera_.get(), check);
    check.raise();
  }

  /// @return false if none came within 50 ms
  bool grab(double exposure, TimedImage& image) {
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(stream_.get(), 50000);
    if (!buffer) return false;
    const bool good = arv_buffer_get_status(buffer) == ARV_BUFFER_STATUS_SUCCESS;
    if (good) copy(buffer, exposure, image);
    arv_stream_push_buffer(stream_.get(), buffer);
    return good;
  }

 private:
  struct Unref {
    void operator()(gpointer object) const { g_object_unref(object); }
  };

  void configure(const CameraOptions& options) {
    Check check;
    arv_camera_set_region(camera_.get(), 0, 0, options.width, options.height, check);
    check.raise();
    arv_camera_set_pixel_format(camera_.get(), ARV_PIXEL_FORMAT_MONO_8, check);
    check.raise();
    // Another program may have left it at one picture.
    arv_camera_set_acquisition_mode(camera_.get(), ARV_ACQUISITION_MODE_CONTINUOUS, check);
    check.raise();
    // Else the camera refuses the exposure, or changes it again.
    if (arv_camera_is_exposure_auto_available(camera_.get(), nullptr)) {
      arv_camera_set_exposure_time_auto(camera_.get(), ARV_AUTO_OFF, check);
      check.raise();
    }
    if (arv_camera_is_gain_auto_available(camera_.get(), nullptr)) {
      arv_camera_set_gain_auto(camera_.get(), ARV_AUTO_OFF, check);
      check.raise();
    }
    arv_camera_set_exposure_time(camera_.get(), 1e6 * options.exposure, check);
    check.raise();
    if (options.trigger == "free") {
      arv_camera_set_frame_rate(camera_.get(), options.rate, check);
    } else {
      arv_camera_set_trigger(camera_.get(),
                             options.trigger == "software" ? "Software" : options.trigger.c_str(),
                             check);
    }
    check.raise();
  }

  /// Copies, so that the buffer can go back to the camera at once.
  static void copy(ArvBuffer* buffer, double exposure, TimedImage& timed) {
    std::size_t size = 0;
    const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_data(buffer, &size));
    auto image = std::make_shared<Image>();
    image->resize(arv_buffer_get_image_width(buffer), arv_buffer_get_image_height(buffer));
    std::copy_n(data, std::min(size, image->pixels.size()), image->pixels.data());
    timed.ns = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer)) -
               std::llround(0.5e9 * exposure);
    timed.t = 1e-9 * static_cast<double>(timed.ns);
    timed.image = image->view();
    timed.owner = image;
  }

  std::unique_ptr<ArvCamera, Unref> camera_;
  std::unique_ptr<ArvStream, Unref> stream_;
};

}  // namespace

class AravisSource::Implementation {
 public:
  explicit Implementation(const CameraOptions& options)
      : options_(options), live_(options.tolerance(), options.silence()) {
    for (const Side side : {kLeft, kRight}) {
      threads_[side] = std::thread([this, side] { serve(side); });
    }
    if (options.trigger == "software") trigger_ = std::thread([this] { trigger(); });
  }
  ~Implementation() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
    if (trigger_.joinable()) trigger_.join();
  }

  LivePair& live() { return live_; }

 private:
  using Clock = std::chrono::steady_clock;

  /// Keeps one camera streaming, whatever happens to it.
  void serve(Side side) {
    while (!stop_) {
      try {
        {
          const auto camera = std::make_shared<Camera>(options_, side);
          std::atomic_store(&cameras_[side], camera);
          stream(side, *camera);
        }
        live_.set_trouble(side, stop_ ? std::nullopt : std::optional<std::string>(lost()));
      } catch (const std::exception& error) {
        live_.set_trouble(side, error.what());
      }
      std::atomic_store(&cameras_[side], std::shared_ptr<Camera>());
      for (int i = 0; i < 5 && !stop_; ++i) std::this_thread::sleep_for(50ms);
    }
  }

  std::string lost() const {
    const bool own = options_.trigger == "software" || options_.trigger == "free";
    return own ? "lost; reconnecting"
               : "lost, or no pulses on " + options_.trigger + "; reconnecting";
  }

  void stream(Side side, Camera& camera) {
    Clock::time_point last = Clock::now();
    TimedImage image;
    const std::chrono::duration<double> patience(options_.patience());
    while (!stop_ && Clock::now() - last < patience) {
      if (!camera.grab(options_.exposure, image)) continue;
      last = Clock::now();
      live_.add(side, image);
    }
  }

  void trigger() {
    const auto period = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / options_.rate));
    Clock::time_point next = Clock::now();
    while (!stop_) {
      next = std::max(next + period, Clock::now());
      std::this_thread::sleep_until(next);
      for (const Side side : {kLeft, kRight}) {
        try {
          if (const auto camera = std::atomic_load(&cameras_[side])) camera->trigger();
        } catch (const std::exception& error) {
          live_.set_trouble(side, error.what());
        }
      }
    }
  }

  const CameraOptions options_;
  LivePair live_;
  std::atomic<bool> stop_{false};
  std::shared_ptr<Camera> cameras_[2];  ///< through std::atomic_load and atomic_store
  std::thread threads_[2], trigger_;
};

AravisSource::AravisSource(const CameraOptions& wanted) {
  CameraOptions options = wanted;
  if (options.trigger.empty()) options.trigger = "software";
  if (options.name[kLeft].empty() || options.name[kRight].empty()) {
    throw BadInput("aravis: expected the names of a left and a right camera");
  }
  options.check("aravis");
  arv_enable_interface("Fake");
  implementation_ = std::make_unique<Implementation>(options);
}

AravisSource::~AravisSource() = default;

FrameSource::Grab AravisSource::next(StereoFrame& frame, double timeout) {
  return implementation_->live().next(frame, timeout) ? Grab::kFrame : Grab::kNothing;
}

std::optional<std::string> AravisSource::trouble() const {
  return implementation_->live().trouble();
}

Pairing::Counts AravisSource::take_counts() {
  return implementation_->live().take_counts();
}

}  // namespace mocap
}  // namespace anthrob
