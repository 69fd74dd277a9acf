#include "robot_connection.h"

#include <regex>

#include "anthrob_core/text.h"

namespace anthrob {

std::optional<std::string> robot_namespace(const std::string& text) {
  static const std::regex kName("/?([A-Za-z]\\w*(/[A-Za-z]\\w*)*)/?");
  std::smatch parts;
  const std::string name = trimmed(text);
  if (!std::regex_match(name, parts, kName)) return std::nullopt;
  return "/" + parts[1].str();
}

}  // namespace anthrob
