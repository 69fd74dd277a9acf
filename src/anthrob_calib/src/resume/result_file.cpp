#include "anthrob_calib/resume/result_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/errors.h"

namespace anthrob {
namespace resume {

namespace {

namespace fs = std::filesystem;

using Word = std::uint64_t;

constexpr char kTitle[] = "anthrob results 1\n";
constexpr std::int64_t kTitleSize = sizeof(kTitle) - 1;
constexpr std::int64_t kHeader = kTitleSize + sizeof(Word);
constexpr std::int64_t kHead = 2 * sizeof(Word);  // key and count

bool read_all(int descriptor, void* to, std::size_t count, std::int64_t offset) {
  char* at = static_cast<char*>(to);
  while (count > 0) {
    const ssize_t got = pread(descriptor, at, count, offset);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got, offset += got, count -= static_cast<std::size_t>(got);
  }
  return true;
}

bool write_all(int descriptor, const void* from, std::size_t count, std::int64_t offset) {
  const char* at = static_cast<const char*>(from);
  while (count > 0) {
    const ssize_t put = pwrite(descriptor, at, count, offset);
    if (put < 0 && errno == EINTR) continue;
    if (put <= 0) return false;
    at += put, offset += put, count -= static_cast<std::size_t>(put);
  }
  return true;
}

template <class Scalar>
std::int64_t record_size(Word count) {
  return kHead + static_cast<std::int64_t>(count * sizeof(Scalar) + sizeof(Word));
}

template <class Scalar>
Word sum_of(Word key, const Scalar* values, Word count) {
  return Fingerprint().add(key).add(values, count * sizeof(Scalar)).value();
}

[[noreturn]] void fail(const std::string& file) {
  throw std::runtime_error(file + ": cannot be written: " + std::strerror(errno));
}

}  // namespace

template <class Scalar>
ResultFile<Scalar>::ResultFile(std::string file, std::uint64_t context)
    : file_(std::move(file)), folder_(fs::path(file_).parent_path()) {
  descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor_ < 0) fail(file_);
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    close(descriptor_);
    throw BadInput(file_ + ": in use by another run; expected another --out folder");
  }
  char title[kHeader];
  char wanted[kHeader];
  std::memcpy(wanted, kTitle, kTitleSize);
  std::memcpy(wanted + kTitleSize, &context, sizeof(context));
  const bool there = read_all(descriptor_, title, kHeader, 0);
  begun_anew_ = there && std::memcmp(title, wanted, kHeader) != 0;
  context_ = context;
  if (there && !begun_anew_) read_index();
}

template <class Scalar>
ResultFile<Scalar>::~ResultFile() {
  // Recordings that were refused leave nothing behind, and spoil nothing that was there.
  if (places_.empty() && !begun_anew_) remove();
  if (places_.empty()) folder_.take_back();
  close(descriptor_);
}

template <class Scalar>
void ResultFile<Scalar>::begin() {
  char header[kHeader];
  std::memcpy(header, kTitle, kTitleSize);
  std::memcpy(header + kTitleSize, &context_, sizeof(context_));
  if (ftruncate(descriptor_, 0) != 0 || !write_all(descriptor_, header, kHeader, 0)) fail(file_);
  end_ = kHeader;
}

template <class Scalar>
void ResultFile<Scalar>::read_index() {
  struct stat about;
  if (fstat(descriptor_, &about) != 0) fail(file_);
  end_ = kHeader;
  Word head[2];
  while (read_all(descriptor_, head, kHead, end_)) {
    const Word count = head[1];
    const auto left = static_cast<Word>(about.st_size - end_);
    if (count > left / sizeof(Scalar) ||
        record_size<Scalar>(count) > static_cast<std::int64_t>(left))
      break;
    places_[head[0]] = {end_, count};
    end_ += record_size<Scalar>(count);
  }
  inherited_ = places_.size();
}

template <class Scalar>
auto ResultFile<Scalar>::find(std::uint64_t key) const -> std::optional<Result> {
  Place place;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = places_.find(key);
    if (found == places_.end()) return std::nullopt;
    place = found->second;
  }
  Result values(static_cast<Eigen::Index>(place.count));
  const std::size_t bytes = place.count * sizeof(Scalar);
  Word sum = 0;
  // A record that a failing machine left half written is no result.
  if (!read_all(descriptor_, values.data(), bytes, place.offset + kHead) ||
      !read_all(descriptor_, &sum, sizeof(sum),
                place.offset + kHead + static_cast<std::int64_t>(bytes)) ||
      sum != sum_of(key, values.data(), place.count)) {
    return std::nullopt;
  }
  return values;
}

template <class Scalar>
void ResultFile<Scalar>::append(std::uint64_t key, const Result& result) {
  const auto offset_of = [&] {
    const auto known = places_.find(key);
    return known == places_.end() ? std::int64_t{-1} : known->second.offset;
  };
  std::int64_t broken = -1;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    broken = offset_of();
  }
  if (broken >= 0 && find(key)) return;
  const auto count = static_cast<Word>(result.size());
  std::vector<char> record(static_cast<std::size_t>(record_size<Scalar>(count)));
  const Word head[] = {key, count}, sum = sum_of(key, result.data(), count);
  std::memcpy(record.data(), head, kHead);
  if (count > 0) std::memcpy(record.data() + kHead, result.data(), count * sizeof(Scalar));
  std::memcpy(record.data() + record.size() - sizeof(sum), &sum, sizeof(sum));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (offset_of() != broken) return;  // another thread was faster
  if (end_ == 0) begin();
  if (!write_all(descriptor_, record.data(), record.size(), end_)) fail(file_);
  places_[key] = {end_, count};
  end_ += static_cast<std::int64_t>(record.size());
}

template <class Scalar>
void ResultFile<Scalar>::remove() {
  unlink(file_.c_str());
}

template class ResultFile<std::uint8_t>;
template class ResultFile<double>;

}  // namespace resume
}  // namespace anthrob
