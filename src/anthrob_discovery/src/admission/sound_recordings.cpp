#include "admission/sound_recordings.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace discovery {

namespace {

void refuse_other_clocks(const Dataset& recording, const SoundnessOptions& options) {
  for (const Table& table : recording.tables) {
    if (table.t.empty()) continue;
    const double late = seconds(table.t.front() - recording.begin());
    const double length = seconds(recording.end() - recording.begin());
    const double covered = seconds(table.t.back() - table.t.front());
    const bool elsewhere =
        late > options.latest_begin * length || covered < options.least_covered * length;
    if (length > 0.0 && table.t.size() > 2 && elsewhere && table.name != "commands") {
      throw BadInput(recording.folder + "/" + table.name +
                     ".csv: not synchronised with the other files: it covers " +
                     significant(covered, 6) + " s, from " + significant(late, 6) +
                     " s on, of a recording of " + significant(length, 6) +
                     " s; expected all files to use one clock");
    }
  }
}

/// What a row holds, in whatever order its columns are.
std::vector<std::uint64_t> rows_of(const Table& table) {
  std::vector<std::uint64_t> rows(table.t.size(), 0);
  for (const Column& column : table.columns) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (!column.present[i]) continue;
      rows[i] += resume::Fingerprint().add(column.name).add(column.values[i]).value();
    }
  }
  return rows;
}

using Stretches = std::unordered_set<std::uint64_t>;

/// Everything in which so much happens that no other recording has the same.
Stretches stretches_of(const Table& table, const SoundnessOptions& options) {
  Stretches stretches;
  const std::vector<std::uint64_t> rows = rows_of(table);
  for (std::size_t i = 0; i + options.stretch <= rows.size(); ++i) {
    const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(i);
    const std::unordered_set<std::uint64_t> distinct(
        begin, begin + static_cast<std::ptrdiff_t>(options.stretch));
    if (distinct.size() < options.distinct) continue;
    stretches.insert(resume::Fingerprint().add(&*begin, options.stretch * sizeof(*begin)).value());
  }
  return stretches;
}

/// By table, of what was measured.
using Contents = std::map<std::string, Stretches>;

Contents contents_of(const Dataset& recording, const SoundnessOptions& options) {
  Contents contents;
  for (const Table& table : recording.tables) {
    Stretches stretches;
    if (table.name != "commands") stretches = stretches_of(table, options);
    if (!stretches.empty()) contents[table.name] = std::move(stretches);
  }
  return contents;
}

/// How much of the shorter one is also in the longer one, from 0 to 1.
double shared(const Stretches& one, const Stretches& two) {
  const Stretches &shorter = one.size() < two.size() ? one : two,
                  &longer = one.size() < two.size() ? two : one;
  const auto common = std::count_if(shorter.begin(), shorter.end(),
                                    [&](std::uint64_t s) { return longer.count(s) > 0; });
  return static_cast<double>(common) / static_cast<double>(shorter.size());
}

/// In the table that shares least: joints without noise may well move alike in true repeats.
double shared(const Contents& one, const Contents& two) {
  double least = 1.0;
  bool any = false;
  for (const auto& [table, stretches] : one) {
    const auto other = two.find(table);
    if (other == two.end()) continue;
    least = std::min(least, shared(stretches, other->second));
    any = true;
  }
  return any ? least : 0.0;
}

}  // namespace

void refuse_nonsense(const RobotModel& robot, const Dataset& recording,
                     const SoundnessOptions& options) {
  for (const Table& table : recording.tables) {
    for (std::size_t i = 1; i < table.t.size(); ++i) {
      if (table.t[i] >= table.t[i - 1]) continue;
      refuse_row(recording, table, i, "time runs backwards: expected rows in order of time");
    }
  }
  refuse_no_numbers(recording);
  refuse_implausible_values(robot, recording);
  refuse_other_clocks(recording, options);
}

std::vector<std::string> remarks_on_stamps(const Dataset& recording,
                                           const SoundnessOptions& options) {
  std::vector<std::string> remarks;
  for (const Table& table : recording.tables) {
    std::size_t repeated = 0;
    for (std::size_t i = 1; i < table.t.size(); ++i) repeated += table.t[i] == table.t[i - 1];
    const double share = static_cast<double>(repeated) / static_cast<double>(table.t.size() + 1);
    if (share < options.repeated_rows) continue;
    remarks.push_back(recording.folder + "/" + table.name + ".csv: " + short_number(100.0 * share) +
                      " % of its rows have the time of the row before: their stamps are wrong");
  }
  return remarks;
}

void refuse_copies(const Question& question) {
  const SoundnessOptions& options = question.options.admission.soundness;
  struct Known {
    std::string folder;
    std::uint64_t content;
    Contents contents;
  };
  std::vector<Known> known;
  for (const auto* group : {&question.train, &question.test, &question.repeats}) {
    for (const Dataset& recording : *group) {
      Known own{recording.folder, resume::content_fingerprint(recording),
                contents_of(recording, options)};
      for (const Known& other : known) {
        const bool same = own.content == other.content;
        const double share = same ? 1.0 : shared(own.contents, other.contents);
        if (share < options.copied) continue;
        const std::string how = same ? ": the same recording as "
                                     : ": " + short_number(100.0 * share) +
                                           " % of the shorter one are the same measurements as in ";
        throw BadInput(own.folder + how + other.folder +
                       ": expected every recording once among --train, --test and --repeat");
      }
      known.push_back(std::move(own));
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
