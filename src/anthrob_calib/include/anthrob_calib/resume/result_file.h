#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace anthrob {
namespace resume {

/// Writes down every result of a simulation as it comes, so that a run that was interrupted goes on
/// with the same bits: it starts again, and what the file knows is not simulated.
///
/// A file of records: key, count, numbers, and a sum over these. What follows a record that is cut
/// off is lost. Used by many threads, by one process at a time.
/// @tparam Scalar float or double
template <class Scalar>
class ResultFile {
 public:
  using Result = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Opens the file; one of another context, or of none, is begun anew. Its folder is made, and
  /// goes again with it if nothing was written.
  /// @param context of all that results depend on beside their keys
  /// @throws BadInput if another run uses it; std::runtime_error if it cannot be written
  ResultFile(std::string file, std::uint64_t context);
  ~ResultFile();
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Results that were there when it was opened.
  std::size_t inherited() const { return inherited_; }
  /// Whether there were some of another context, which are gone now.
  bool begun_anew() const { return begun_anew_; }
  std::optional<Result> find(std::uint64_t key) const;
  void append(std::uint64_t key, const Result& result);
  /// It has served: the file goes.
  void remove();

 private:
  struct Place {
    std::int64_t offset;  ///< of the record
    std::uint64_t count;  ///< of numbers
  };

  void read_index();

  std::string file_;
  bool made_folder_ = false, begun_anew_ = false;
  int descriptor_ = -1;
  std::int64_t end_ = 0;
  std::size_t inherited_ = 0;
  std::unordered_map<std::uint64_t, Place> places_;
  mutable std::mutex mutex_;
};

}  // namespace resume
}  // namespace anthrob
