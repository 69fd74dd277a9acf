#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "anthrob_core/files.h"

namespace anthrob {
namespace resume {

/// Stores each result of a simulation as soon as it is computed. An interrupted run starts again,
/// takes the stored results from this file instead of simulating, and so ends with the same bits.
///
/// The file consists of records: key, count, numbers, and a checksum. Records behind one that is
/// cut off are lost. Several threads may use it, but only one process at a time.
/// @tparam Scalar double or std::uint8_t
template <class Scalar>
class ResultFile {
 public:
  using Result = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Opens the file. If it has another context or is not such a file, the first result replaces it:
  /// a run that is refused before spoils nothing. Creates its folder; if nothing gets written, the
  /// destructor removes what was created.
  /// @param context fingerprint of everything that results depend on beside their keys
  /// @throws BadInput if another run uses it; std::runtime_error if it cannot be written
  ResultFile(std::string file, std::uint64_t context);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Number of results that the file held when it was opened.
  std::size_t inherited() const { return inherited_; }
  /// Whether the file had another context, so that its results do not count.
  bool begun_anew() const { return begun_anew_; }
  std::optional<Result> find(std::uint64_t key) const;
  /// What it holds already stays: others may be packed by it.
  void append(std::uint64_t key, const Result& result);
  /// Deletes the file, once it is no longer needed.
  void remove();

 private:
  struct Place {
    std::int64_t offset;  ///< of the record
    std::uint64_t count;  ///< of numbers
  };

  void read_index();
  /// Makes it a file of this context without results.
  void begin();

  std::string file_;
  MadeFolder folder_;
  bool begun_anew_ = false;
  int descriptor_ = -1;
  std::uint64_t context_ = 0;
  std::int64_t end_ = 0;  ///< 0: nothing of this context has been written
  std::size_t inherited_ = 0;
  std::unordered_map<std::uint64_t, Place> places_;
  mutable std::mutex mutex_;
};

}  // namespace resume
}  // namespace anthrob
