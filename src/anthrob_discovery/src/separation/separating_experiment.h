#pragma once

#include <string>

namespace anthrob {
namespace discovery {

/// The experiment that tells two effects apart, in words. A general one if none is known for the
/// two.
std::string separating_experiment(const std::string& id, const std::string& rival);

}  // namespace discovery
}  // namespace anthrob
