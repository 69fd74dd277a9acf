#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "anthrob_calib/resume/result_file.h"
#include "experiment/packed_differences.h"

namespace anthrob {
namespace discovery {

/// What was simulated before an interruption, in a file, bit for bit. Variants of a model that
/// follow each other differ by little, so each result is packed by its differences from an earlier
/// one of the same recordings. Where that does not save much, it is packed by the first of all, and
/// is what the next ones are packed by. Several threads may use it.
class Journal {
 public:
  /// @param context fingerprint of everything that results depend on beside their keys
  /// @throws see resume::ResultFile
  Journal(const std::string& file, std::uint64_t context) : file_(file, context) {}

  std::size_t inherited() const { return file_.inherited(); }
  bool begun_anew() const { return file_.begun_anew(); }
  void remove() { file_.remove(); }

  /// @param recordings fingerprint of the recordings that a variant was compared with
  std::optional<Eigen::VectorXf> find(std::uint64_t key, std::uint64_t recordings);
  void append(std::uint64_t key, std::uint64_t recordings, const Eigen::VectorXf& result);

 private:
  /// What others are packed by. Key 0: nothing.
  struct Reference {
    std::uint64_t key = 0;
    Eigen::VectorXf numbers = {};
  };
  Reference reference(std::uint64_t name);
  void keep(std::uint64_t name, Reference reference);

  resume::ResultFile<std::uint8_t> file_;
  /// By recordings: what results are packed by now. By their complements: the first ones.
  std::map<std::uint64_t, Reference> references_;
  std::mutex mutex_;  ///< of references_
};

}  // namespace discovery
}  // namespace anthrob
