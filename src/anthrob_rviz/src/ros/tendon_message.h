#pragma once

#include <anthrob_msgs/TendonPaths.h>

#include <optional>
#include <string>
#include <vector>

#include "tendon.h"

namespace anthrob {

/// What a message says, or what is wrong with it.
struct HeardTendons {
  std::vector<Tendon> tendons;
  std::optional<std::string> wrong;
};
HeardTendons tendons_of(const anthrob_msgs::TendonPaths& message);

}  // namespace anthrob
