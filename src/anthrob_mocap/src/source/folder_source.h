#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "source/frame_source.h"

namespace anthrob {
namespace mocap {

/// Pairs of images 000000.png, ... of two folders, in the order of the last number in their names,
/// which is their index (names without any number: in the order of the names). Times are in
/// times.csv ("index,t") in a folder or beside it, of one side or of both (then for all images);
/// without it, the index divided by the rate. A pair of which a picture is missing, damaged or not
/// 8-bit grey has a fault; hours of recording are worth more than one picture.
class FolderSource final : public FrameSource {
 public:
  /// [1] of all pairs; with more faults than that, the folders are not what they should be.
  static constexpr double kMostFaults = 0.1;

  struct Options {
    double rate = 60.0;             ///< [Hz] without times.csv
    double sync_tolerance = 0.002;  ///< [s] between times of left and right
  };

  /// @throws BadInput if folders, names or times of left and right do not belong together, or if
  ///   pictures are missing in more than kMostFaults of the pairs
  FolderSource(const std::string& left, const std::string& right, const Options& options);

  /// What is assumed about the times where there is no times.csv; else none.
  const std::optional<std::string>& assumption() const { return assumption_; }

  std::size_t pairs() const { return names_.size(); }  ///< also those with faults

  Grab next(StereoFrame& frame, double timeout) override;

 private:
  using Times = std::map<long, double>;
  static Times read_times(const std::string& file);
  void list_names();
  void sort_names();
  void load_times(const Options& options);
  /// @param file of the right ones
  static void check_times(const Times& left, const Times& right, const std::string& file,
                          double tolerance);

  std::string folder_[2];
  std::vector<std::string> names_;
  std::vector<long> indices_;  ///< by name
  std::vector<double> times_;
  std::optional<std::string> assumption_;
  std::size_t position_ = 0;
};

}  // namespace mocap
}  // namespace anthrob
