#include "source/dc1394_source.h"

#include <dc1394/dc1394.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <thread>

#include "anthrob_core/errors.h"
#include "source/live_pair.h"

namespace anthrob {
namespace mocap {

namespace {

using namespace std::chrono_literals;

constexpr int kBuffers = 8;

void check(dc1394error_t code, const char* what) {
  if (code != DC1394_SUCCESS) {
    throw std::runtime_error(std::string(what) + ": " + dc1394_error_get_string(code));
  }
}

/// Whether the cameras wait for pulses on their wires.
bool parse_trigger(const std::string& word) {
  if (word == "free") return false;
  if (word.empty() || word == "external") return true;
  throw BadInput("dc1394: trigger '" + word + "': expected external or free");
}

/// One open camera that streams.
class Camera {
 public:
  Camera(dc1394_t* bus, std::uint64_t guid, const CameraOptions& options)
      : camera_(dc1394_camera_new(bus, guid)) {
    if (!camera_) throw std::runtime_error("no such camera on the bus");
    dc1394camera_t* camera = camera_.get();
    check(dc1394_video_set_mode(camera, DC1394_VIDEO_MODE_FORMAT7_0), "cannot set the video mode");
    check(dc1394_format7_set_roi(camera, DC1394_VIDEO_MODE_FORMAT7_0, DC1394_COLOR_CODING_MONO8,
                                 DC1394_USE_MAX_AVAIL, 0, 0, options.width, options.height),
          "cannot set the image region");
    // Else the camera changes the exposure again.
    set_manual(DC1394_FEATURE_SHUTTER, "cannot switch the automatic exposure off");
    set_manual(DC1394_FEATURE_GAIN, "cannot switch the automatic gain off");
    check(dc1394_feature_set_absolute_control(camera, DC1394_FEATURE_SHUTTER, DC1394_ON),
          "cannot set the exposure");
    check(dc1394_feature_set_absolute_value(camera, DC1394_FEATURE_SHUTTER,
                                            static_cast<float>(options.exposure)),
          "cannot set the exposure");
    const bool external = parse_trigger(options.trigger);
    if (external) {
      // One picture a pulse, exposed for as long as SHUTTER says.
      check(dc1394_external_trigger_set_mode(camera, DC1394_TRIGGER_MODE_0),
            "cannot set the trigger mode");
    }
    check(dc1394_external_trigger_set_power(camera, external ? DC1394_ON : DC1394_OFF),
          "cannot set the trigger");
    check(dc1394_capture_setup(camera, kBuffers, DC1394_CAPTURE_FLAGS_DEFAULT),
          "cannot set up the capture");
    check(dc1394_video_set_transmission(camera, DC1394_ON), "cannot start the transmission");
  }
  ~Camera() {
    dc1394_video_set_transmission(camera_.get(), DC1394_OFF);
    dc1394_capture_stop(camera_.get());
  }

  /// Where the camera has such a mode.
  void set_manual(dc1394feature_t feature, const char* what) {
    dc1394feature_modes_t modes;
    check(dc1394_feature_get_modes(camera_.get(), feature, &modes), what);
    const dc1394feature_mode_t* begin = modes.modes;
    const dc1394feature_mode_t* end = begin + modes.num;
    if (std::find(begin, end, DC1394_FEATURE_MODE_MANUAL) == end) return;
    check(dc1394_feature_set_mode(camera_.get(), feature, DC1394_FEATURE_MODE_MANUAL), what);
  }

  bool grab(double exposure, TimedImage& timed) {
    dc1394video_frame_t* frame = nullptr;
    check(dc1394_capture_dequeue(camera_.get(), DC1394_CAPTURE_POLICY_POLL, &frame),
          "cannot read an image");
    if (!frame) return false;
    const bool good = !dc1394_capture_is_frame_corrupt(camera_.get(), frame);
    if (good) {
      auto image = std::make_shared<Image>();
      image->resize(static_cast<int>(frame->size[0]), static_cast<int>(frame->size[1]));
      for (int y = 0; y < image->height; ++y) {
        std::copy_n(frame->image + static_cast<std::size_t>(y) * frame->stride, image->width,
                    image->row(y));
      }
      timed.ns =
          1000 * static_cast<std::int64_t>(frame->timestamp) - std::llround(0.5e9 * exposure);
      timed.t = 1e-9 * static_cast<double>(timed.ns);
      timed.image = image->view();
      timed.owner = image;
    }
    dc1394_capture_enqueue(camera_.get(), frame);
    return good;
  }

 private:
  struct Free {
    void operator()(dc1394camera_t* camera) const { dc1394_camera_free(camera); }
  };
  std::unique_ptr<dc1394camera_t, Free> camera_;
};

std::uint64_t parse_guid(const std::string& name) {
  char* end = nullptr;
  const std::uint64_t guid = std::strtoull(name.c_str(), &end, 16);
  if (name.empty() || *end != 0 || guid == 0) {
    throw BadInput("dc1394: camera '" + name + "': expected a GUID in hexadecimal");
  }
  return guid;
}

}  // namespace

class Dc1394Source::Implementation {
 public:
  explicit Implementation(const CameraOptions& options)
      : options_(options),
        guid_{parse_guid(options.name[kLeft]), parse_guid(options.name[kRight])},
        live_(options.tolerance(), options.silence()) {
    for (const Side side : {kLeft, kRight})
      threads_[side] = std::thread([this, side] { serve(side); });
  }
  ~Implementation() {
    stop_ = true;
    for (std::thread& thread : threads_) thread.join();
  }

  LivePair& live() { return live_; }

 private:
  struct FreeBus {
    void operator()(dc1394_t* bus) const { dc1394_free(bus); }
  };

  void serve(Side side) {
    while (!stop_) {
      try {
        const std::unique_ptr<dc1394_t, FreeBus> bus(dc1394_new());
        if (!bus) throw std::runtime_error("no FireWire bus");
        Camera camera(bus.get(), guid_[side], options_);
        auto last = std::chrono::steady_clock::now();
        const std::chrono::duration<double> patience(options_.patience());
        TimedImage image;
        while (!stop_ && std::chrono::steady_clock::now() - last < patience) {
          if (camera.grab(options_.exposure, image)) {
            last = std::chrono::steady_clock::now();
            live_.add(side, image);
          } else {
            std::this_thread::sleep_for(500us);
          }
        }
        live_.set_trouble(side, parse_trigger(options_.trigger)
                                    ? "lost, or no pulses on its trigger wire; reconnecting"
                                    : "lost; reconnecting");
      } catch (const std::exception& error) {
        live_.set_trouble(side, error.what());
      }
      for (int i = 0; i < 5 && !stop_; ++i) std::this_thread::sleep_for(50ms);
    }
  }

  const CameraOptions options_;
  const std::uint64_t guid_[2];
  LivePair live_;
  std::atomic<bool> stop_{false};
  std::thread threads_[2];
};

Dc1394Source::Dc1394Source(const CameraOptions& options) {
  parse_trigger(options.trigger);
  options.check("dc1394");
  implementation_ = std::make_unique<Implementation>(options);
}

Dc1394Source::~Dc1394Source() = default;

FrameSource::Grab Dc1394Source::next(StereoFrame& frame, double timeout) {
  return implementation_->live().next(frame, timeout) ? Grab::kFrame : Grab::kNothing;
}

std::optional<std::string> Dc1394Source::trouble() const {
  return implementation_->live().trouble();
}

Pairing::Counts Dc1394Source::take_counts() {
  return implementation_->live().take_counts();
}

}  // namespace mocap
}  // namespace anthrob
