#include "gains/gain_table.h"

#include <algorithm>

namespace anthrob {
namespace {

/// Each once, in the order of their first appearance.
std::vector<std::string> each_once(const std::vector<Gain>& gains, std::string Gain::*of) {
  std::vector<std::string> result;
  for (const Gain& gain : gains) {
    if (std::find(result.begin(), result.end(), gain.*of) == result.end()) {
      result.push_back(gain.*of);
    }
  }
  return result;
}

}  // namespace

void GainTable::hear(const std::vector<Gain>& held, Why why) {
  std::vector<Gain> replaced = replaced_by(held);
  // An undo that was refused can be tried again.
  if (why == Why::kUndo && can_undo() && !replaced.empty()) changes_.pop_back();
  if (why == Why::kChange && !replaced.empty()) changes_.push_back(std::move(replaced));
  held_ = held;
}

void GainTable::clear() {
  held_.clear();
  changes_.clear();
}

std::vector<std::string> GainTable::muscles() const {
  return each_once(held_, &Gain::muscle);
}

std::vector<std::string> GainTable::names() const {
  return each_once(held_, &Gain::name);
}

std::optional<GainTable::Entry> GainTable::entry(const std::string& muscle,
                                                 const std::string& name) const {
  std::optional<Entry> result;
  for (const Gain& gain : held_) {
    if (gain.name != name || (!muscle.empty() && gain.muscle != muscle)) continue;
    if (!result) {
      result = Entry{gain.value, true};
    } else if (gain.value != result->value) {
      result->same = false;
    }
  }
  return result;
}

std::vector<Gain> GainTable::replaced_by(const std::vector<Gain>& held) const {
  std::vector<Gain> result;
  for (const Gain& old : held_) {
    const auto now = std::find_if(held.begin(), held.end(), [&](const Gain& gain) {
      return gain.muscle == old.muscle && gain.name == old.name;
    });
    if (now != held.end() && now->value != old.value) result.push_back(old);
  }
  return result;
}

}  // namespace anthrob
