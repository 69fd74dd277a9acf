#pragma once

#include <string>

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// All channels together, before and after, of what was learned from and what was held out.
std::string gap_table(const Answer& answer);

/// Each effect with its parameters, rivals and what tells them apart; and what was not named.
std::string findings(const Answer& answer);

}  // namespace discovery
}  // namespace anthrob
