#include "experiment/journal.h"

#include <cstring>
#include <utility>

namespace anthrob {
namespace discovery {

namespace {

using Key = std::uint64_t;

/// The key of the reference, then what was packed by it.
Packed with_reference(Key reference, const Packed& bytes) {
  Packed record(static_cast<Eigen::Index>(sizeof(reference)) + bytes.size());
  std::memcpy(record.data(), &reference, sizeof(reference));
  record.tail(bytes.size()) = bytes;
  return record;
}

Key reference_in(const Packed& record) {
  Key reference = 0;
  std::memcpy(&reference, record.data(), sizeof(reference));
  return reference;
}

Packed bytes_in(const Packed& record) {
  return record.tail(record.size() - static_cast<Eigen::Index>(sizeof(Key)));
}

/// Results that are near take four to five bits a number, all others seven and more.
bool saves_much(const Packed& bytes, const Eigen::VectorXf& result) {
  return 8 * bytes.size() < 6 * result.size();
}

/// Of the first one.
Key first_of(Key recordings) {
  return ~recordings;
}

}  // namespace

Journal::Reference Journal::reference(Key name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return references_[name];
}

void Journal::keep(Key name, Reference reference) {
  const std::lock_guard<std::mutex> lock(mutex_);
  references_[name] = std::move(reference);
}

std::optional<Eigen::VectorXf> Journal::find(Key key, Key recordings) {
  const auto record = file_.find(key);
  if (!record) return std::nullopt;
  const Key by = reference_in(*record);
  Reference found;
  if (by != 0) found = reference(recordings);
  if (found.key != by) found = reference(first_of(recordings));
  if (found.key != by) {
    auto numbers = find(by, recordings);
    if (!numbers) return std::nullopt;
    found = {by, std::move(*numbers)};
  }
  Eigen::VectorXf result = unpacked(bytes_in(*record), found.numbers);
  if (result.size() > 0 && by == 0) keep(first_of(recordings), {key, result});
  if (result.size() > 0 && by == reference(first_of(recordings)).key) {
    keep(recordings, {key, result});
  }
  return result;
}

void Journal::append(Key key, Key recordings, const Eigen::VectorXf& result) {
  const Reference by = reference(recordings);
  const Packed bytes = packed(result, by.numbers);
  if (result.size() == 0 || saves_much(bytes, result)) {
    file_.append(key, with_reference(by.key, bytes));
    return;
  }
  const Reference first = reference(first_of(recordings));
  file_.append(key, with_reference(first.key, packed(result, first.numbers)));
  if (first.key == 0) keep(first_of(recordings), {key, result});
  keep(recordings, {key, result});
}

}  // namespace discovery
}  // namespace anthrob
