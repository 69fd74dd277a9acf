#include "dataset/clocks.h"

#include <algorithm>
#include <limits>

#include "anthrob_core/errors.h"

namespace anthrob {

namespace {

/// A command may be given long before the robot is recorded, but nobody waits longer.
constexpr Nanoseconds kApart = Nanoseconds{60} * 1000000000;

struct Span {
  Nanoseconds begin = std::numeric_limits<Nanoseconds>::max();
  Nanoseconds end = std::numeric_limits<Nanoseconds>::min();

  bool empty() const { return begin > end; }
  void add(const Table& table) {
    if (table.t.empty()) return;
    begin = std::min(begin, table.t.front());
    end = std::max(end, table.t.back());
  }
};

}  // namespace

void check_clocks(Dataset& dataset) {
  for (const Table& table : dataset.tables) {
    Span own, others;
    own.add(table);
    for (const Table& other : dataset.tables) {
      if (&other != &table) others.add(other);
    }
    if (own.empty() || others.empty()) continue;
    const std::string who = dataset.folder + "/" + table.name + ".csv: ";
    // Differences of times that a clock can have fit, for a table's times are checked.
    if (own.begin - others.end > kApart || others.begin - own.end > kApart) {
      const bool late = own.begin > others.end;
      throw BadInput(who + "not synchronised with the other files: it " +
                     (late ? "begins " + time_text(own.begin - others.end) + " s after they end"
                           : "ends " + time_text(others.begin - own.end) + " s before they begin") +
                     "; expected all files to use one clock");
    }
    if (others.begin - own.begin > kApart) {
      dataset.remarks.push_back(who + "begins " + time_text(others.begin - own.begin) +
                                " s before the other files: a latched message, or a wrong clock? "
                                "A replay begins there");
    }
  }
}

}  // namespace anthrob
