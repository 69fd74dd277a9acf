#pragma once

#include <string>

namespace anthrob {
namespace discovery {

/// The recording that tells two effects apart, in words; empty if none is known or needed.
std::string separating_experiment(const std::string& id, const std::string& rival);

}  // namespace discovery
}  // namespace anthrob
