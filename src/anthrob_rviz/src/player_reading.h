#pragma once

#include <string>

namespace anthrob {

/// What a player says of itself.
struct PlayerReading {
  std::string bag;
  double duration = 0.0, position = 0.0;  ///< [s]
  double rate = 1.0;
  bool paused = false;
};

}  // namespace anthrob
