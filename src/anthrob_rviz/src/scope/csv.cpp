#include "scope/csv.h"

#include <algorithm>
#include <optional>

namespace anthrob {
namespace {

/// As RFC 4180 has it.
std::string cell_of(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// The rest of a column.
struct Rest {
  const Sample* next;
  const Sample* end;
  Nanoseconds origin;

  Nanoseconds time() const { return next->t - origin; }
};

std::optional<Nanoseconds> earliest(const std::vector<Rest>& rests) {
  std::optional<Nanoseconds> t;
  for (const Rest& rest : rests) {
    if (rest.next != rest.end) t = std::min(t.value_or(rest.time()), rest.time());
  }
  return t;
}

}  // namespace

void write_csv(const std::string& time_name, const std::vector<CsvColumn>& columns,
               std::ostream& out) {
  out << cell_of(time_name);
  std::vector<Rest> rests;
  for (const CsvColumn& column : columns) {
    out << ',' << cell_of(column.name);
    rests.push_back({column.samples.begin(), column.samples.end(), column.origin});
  }
  out << '\n';
  while (const auto t = earliest(rests)) {
    out << time_text(*t);
    for (Rest& rest : rests) {
      out << ',';
      if (rest.next == rest.end || rest.time() != *t) continue;
      out << exact_text(rest.next->value);
      ++rest.next;
    }
    out << '\n';
  }
}

}  // namespace anthrob
