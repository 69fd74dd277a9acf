#include "source/camera_options.h"

#include <sstream>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {

void CameraOptions::check(const std::string& source) const {
  std::ostringstream text;
  text << source << ": ";
  if (!(rate > 0.0) || !(exposure > 0.0)) {
    text << "rate " << rate << ", exposure " << exposure << ": expected both > 0";
    throw BadInput(text.str());
  }
  // A value in another unit would shift the stamps by half of itself.
  if (!(exposure < 1.0 / rate)) {
    text << "exposure " << exposure << " s: expected less than " << 1.0 / rate
         << " s, the period at a rate of " << rate << " Hz";
    throw BadInput(text.str());
  }
  // A wider one brings together images one period apart.
  if (!(sync_tolerance <= 0.5 / rate)) {
    text << "sync_tolerance " << sync_tolerance << " s: expected at most " << 0.5 / rate
         << " s, half a period at a rate of " << rate << " Hz";
    throw BadInput(text.str());
  }
}

}  // namespace mocap
}  // namespace anthrob
