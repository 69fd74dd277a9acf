#pragma once

#include <nlohmann/json.hpp>

#include "options/options.h"

namespace anthrob {
namespace discovery {

/// {"admission": {"shortest": 2.0, ..., "frozen": {...}}, ...}
nlohmann::ordered_json options_json(const Options& options);

}  // namespace discovery
}  // namespace anthrob
