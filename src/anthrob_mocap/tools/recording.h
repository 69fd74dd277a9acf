#pragma once

#include <CLI/CLI.hpp>
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

/// Tracks all pairs of a recording.
/// @return false if it was interrupted
/// @throws BadInput if an image cannot be used or is not as large as calibrated
bool track_all(FolderSource& source, const StereoRig& rig, const Recording& recording,
               Pipeline& pipeline);

}  // namespace mocap
}  // namespace anthrob
