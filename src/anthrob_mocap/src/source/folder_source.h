#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Pairs of images 000000.png, ... of two folders, in the order of the last number in their names,
/// which is their index (names without any number: in the order of the names). Times are in
/// times.csv ("index,t") in a folder or beside it. If each folder has its own, what was taken at
/// one time is a pair; else what has one name, with the times of the one file, or without it the
/// index divided by the rate. A pair of which a picture is missing, damaged or not 8-bit grey has
/// a fault; hours of recording are worth more than one picture.
class FolderSource final : public FrameSource {
 public:
  /// [1] of all pairs; with more faults than that, the folders are not what they should be.
  static constexpr double kMostFaults = 0.1;

  struct Options {
    double rate = 60.0;             ///< [Hz] without times.csv
    double sync_tolerance = 0.002;  ///< [s] between times of left and right
  };

  /// @throws BadInput if folders, names or times of left and right do not belong together, or if
  ///   pictures are missing in more than kMostFaults of the pairs, or none have a common time
  FolderSource(const std::string& left, const std::string& right, const Options& options);

  /// What is assumed about the times where there is no times.csv; else none.
  const std::optional<std::string>& assumption() const { return assumption_; }

  /// How many pictures of two times.csv have no partner; none if all have.
  const std::optional<std::string>& loss() const { return loss_; }
  std::size_t pairs() const { return pairs_.size(); }  ///< also those with faults

  Grab next(StereoFrame& frame, double timeout) override;

 private:
  struct Pair {
    std::string name[2];  ///< of the files; the pictures may be missing
    double t;             ///< [s] of the left picture
  };
  void pair_by_names(const std::optional<std::string>& times_file, double rate);
  void pair_by_times(const std::array<std::string, 2>& times_files, double tolerance);
  void judge(const Pairing::Counts& counts, double tolerance);

  std::string folder_[2];
  std::vector<Pair> pairs_;
  std::optional<std::string> assumption_, loss_;
  std::size_t position_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
