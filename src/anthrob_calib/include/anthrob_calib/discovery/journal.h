#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

namespace anthrob {
namespace discovery {

/// Writes down every result of a simulation as it comes, so that a run that was interrupted goes on
/// with the same bits: it starts again, and what the journal knows is not simulated.
///
/// A file of records: key, count, floats, and a sum over these. What follows a record that is cut
/// off is lost. Used by many threads, by one process at a time.
class Journal {
 public:
  /// Opens the file; one of another context, or of none, is begun anew. Its folder is made, and
  /// goes again with the journal if nothing was written.
  /// @param context of all that results depend on beside their keys
  /// @throws BadInput if another run uses it; std::runtime_error if it cannot be written
  Journal(std::string file, std::uint64_t context);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Results that were there when it was opened.
  std::size_t inherited() const { return inherited_; }
  std::optional<Eigen::VectorXf> find(std::uint64_t key) const;
  void append(std::uint64_t key, const Eigen::VectorXf& result);
  /// It has served: the file goes.
  void remove();

 private:
  struct Place {
    std::int64_t offset;  ///< of the record
    std::uint64_t count;  ///< of floats
  };

  void read_index();

  std::string file_;
  bool made_folder_ = false;
  int descriptor_ = -1;
  std::int64_t end_ = 0;
  std::size_t inherited_ = 0;
  std::unordered_map<std::uint64_t, Place> places_;
  mutable std::mutex mutex_;
};

}  // namespace discovery
}  // namespace anthrob
