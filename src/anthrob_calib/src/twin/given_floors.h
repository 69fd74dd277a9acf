#pragma once

#include <map>
#include <string>

#include "twin/channels.h"

namespace anthrob {
namespace twin {

/// Floors by channel, in the channel's unit, for averages over a bin.
using Floors = std::map<std::string, double>;

/// Reads `floors: {biceps_brachii/force: 0.2}`.
/// @throws BadInput naming file, line and key: an unknown channel, a number that is not positive
Floors load_floors(const std::string& file, const Channels& channels);

}  // namespace twin
}  // namespace anthrob
