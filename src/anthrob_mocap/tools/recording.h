#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "pipeline/health.h"
#include "pipeline/tracker.h"
#include "source/folder_source.h"

namespace anthrob {
namespace mocap {

/// What a command line says about a recording: its images, and the calibration of their cameras.
struct Recording {
  std::string left, right, calibration;
  FolderSource::Options folder;

  void add_options(CLI::App& app);

  /// @throws BadInput if what was seen says that images and calibration do not belong together
  void refuse_contradiction(const Health& health) const;
};

/// Counts the pairs of a recording that cannot be used.
class LeftOut {
 public:
  /// @param pairs of the whole recording
  explicit LeftOut(std::size_t pairs) : pairs_(pairs) {}

  /// @throws BadInput if they are more than FolderSource::kMostFaults of all pairs
  void add(const std::string& why);
  /// How many they are, and the first; none if all pairs could be used.
  std::optional<std::string> warning() const;

 private:
  std::size_t pairs_, count_ = 0;
  std::string first_;
};

/// Tracks all pairs of a recording. Nothing is seen in those that are left out: pictures that are
/// missing, damaged, or not as large as calibrated.
/// @return false if it was interrupted
/// @throws BadInput as LeftOut::add
bool track_all(FolderSource& source, const StereoRig& rig, const Recording& recording,
               Pipeline& pipeline, LeftOut& left_out);

}  // namespace mocap
}  // namespace anthrob
