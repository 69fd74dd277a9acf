#pragma once

#include <string>

namespace anthrob {

/// A gain of a muscle's control law, in the unit of its parameter.
struct Gain {
  std::string muscle;  ///< empty in a request: all muscles
  std::string name;    ///< "position_proportional"
  double value = 0.0;
};

}  // namespace anthrob
