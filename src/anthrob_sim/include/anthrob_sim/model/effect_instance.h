#pragma once

#include <map>
#include <string>

namespace anthrob {

/// An effect at a place, as a file, a command line or a search names it; see effects/catalogue.h.
/// Parameters left out are neutral.
struct EffectInstance {
  std::string id, place;
  std::map<std::string, double> parameters;
};

}  // namespace anthrob
