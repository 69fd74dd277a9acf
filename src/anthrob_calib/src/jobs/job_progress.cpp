#include "jobs/job_progress.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace anthrob {
namespace jobs {

void ProgressReader::read(const std::string& piece) {
  rest_ += piece;
  for (std::size_t end; (end = rest_.find('\n')) != std::string::npos;) {
    read_line(rest_.substr(0, end));
    rest_.erase(0, end + 1);
  }
}

/// Each line has what has changed.
void ProgressReader::read_line(const std::string& line) {
  const auto json = nlohmann::json::parse(line, nullptr, false);
  if (!json.is_object()) return;  // of a program that was killed while it wrote
  const auto take = [&](const char* key, auto& to) {
    if (json.contains(key) && json[key].is_string()) to = json[key].get<std::string>();
  };
  take("stage", progress_.stage);
  take("best", progress_.best);
  take("headline", progress_.headline);
  take("error", progress_.error);
  if (!json.contains("share") || !json["share"].is_number()) return;
  progress_.share = std::clamp(json["share"].get<double>(), 0.0, 1.0);
  progress_.seconds_left.reset();
  if (json.contains("seconds_left") && json["seconds_left"].is_number()) {
    progress_.seconds_left = json["seconds_left"].get<double>();
  }
}

}  // namespace jobs
}  // namespace anthrob
