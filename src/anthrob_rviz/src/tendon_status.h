#pragma once

#include <optional>
#include <set>
#include <string>

#include "diagnostics.h"

namespace anthrob {

/// One line of a display's status.
struct StatusLine {
  Level level;
  std::string text;
};

/// Messages older than this say nothing of forces now [s of wall time].
constexpr double kOldTendons = 1.0;

/// What is known of the topic that a display listens to.
struct TendonFeed {
  std::string topic;
  int publishers = 0;
  std::optional<double> age;         ///< [s of wall time] of the last message; none: none came
  std::optional<std::string> wrong;  ///< what is, with the last message
  std::size_t tendons = 0;
  bool is_old() const { return !age || *age > kOldTendons; }
};

StatusLine feed_status(const TendonFeed& feed);
StatusLine link_status(const std::set<std::string>& links, const std::set<std::string>& lost);

}  // namespace anthrob
