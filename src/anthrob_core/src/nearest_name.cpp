#include "anthrob_core/nearest_name.h"

#include <algorithm>
#include <cctype>

namespace anthrob {

namespace {

/// Nobody misspells longer names, and the cost grows with the square.
constexpr std::size_t kLongest = 100;

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Optimal string alignment distance: insertions, deletions, substitutions, swaps of neighbours.
std::size_t errors_between(const std::string& a, const std::string& b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> cost((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return cost[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t other = a[i - 1] == b[j - 1] ? 0 : 1;
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, at(i - 1, j - 1) + other});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
      }
    }
  }
  return cost.back();
}

/// The only known name that begins so.
std::optional<std::string> completed(const std::string& beginning,
                                     const std::vector<std::string>& known) {
  constexpr std::size_t kFewest = 3;
  std::optional<std::string> only;
  if (beginning.size() < kFewest) return only;
  for (const std::string& candidate : known) {
    if (lower_case(candidate).rfind(lower_case(beginning), 0) != 0) continue;
    if (only) return std::nullopt;
    only = candidate;
  }
  return only;
}

}  // namespace

std::optional<std::string> nearest_name(const std::string& name,
                                        const std::vector<std::string>& known) {
  std::optional<std::string> nearest;
  if (name.size() > kLongest) return nearest;
  std::size_t least = 0;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest) continue;
    const std::size_t errors = errors_between(lower_case(name), lower_case(candidate));
    const std::size_t allowed = std::max<std::size_t>(1, (candidate.size() + 1) / 3);
    if (errors >= candidate.size()) continue;  // no letter is right
    if (errors > allowed || (nearest && errors >= least)) continue;
    nearest = candidate;
    least = errors;
  }
  return nearest ? nearest : completed(name, known);
}

std::string expected_names(const std::string& name, const std::vector<std::string>& known) {
  if (const auto nearest = nearest_name(name, known)) return "; did you mean '" + *nearest + "'?";
  if (known.empty()) return "; expected none";
  std::string all;
  for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
  return "; expected one of " + all;
}

}  // namespace anthrob
