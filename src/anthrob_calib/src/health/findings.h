#pragma once

#include <string>
#include <vector>

#include "health/trend.h"

namespace anthrob {
namespace health {

/// Something about a tendon that is not as it was, and what is likely behind it.
struct Finding {
  std::string muscle, cause;
  std::vector<Quantity> quantities;  ///< by which it shows
  double days = 0.0;                 ///< until a limit is reached; infinite: not known
  std::string text() const;  ///< "brachialis: ... (stiffness -9 %), reaches its limit in 12 days"
  std::string evidence;      ///< "stiffness -9 %, creep +0.06"
};

/// Changes that are certain, by muscle. What one cause explains is one finding.
std::vector<Finding> findings(const History& history, const HealthOptions& options);

}  // namespace health
}  // namespace anthrob
