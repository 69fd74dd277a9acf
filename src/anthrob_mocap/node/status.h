#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/health.h"
#include "pipeline/tracker.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

/// What the node has seen since the last report. Frames and reports may come from two threads.
class Status {
 public:
  /// @param recorded the time from exposure to result says nothing and is not reported
  Status(const std::string& name, const StereoRig& rig, const TargetSet& set,
         const TrackerOptions& options, bool recorded);

  /// @param delay [s] from exposure to result
  void add(const StereoFrame& frame, double delay);
  /// An image that could not be used, and why.
  void refuse(const std::string& why);

  /// @param elapsed [s] since the last report
  /// @param trouble of the source, if it has any: an error
  /// @param images counts of the source since its last take_counts
  diagnostic_msgs::DiagnosticStatus report(double elapsed,
                                           const std::optional<std::string>& trouble,
                                           const Pairing::Counts& images);

 private:
  void judge(const std::optional<std::string>& trouble, const Pairing::Counts& images,
             diagnostic_msgs::DiagnosticStatus& status) const;
  void list_values(double elapsed, diagnostic_msgs::DiagnosticStatus& status);
  void clear();

  std::string name_;
  bool recorded_;
  std::vector<std::string> targets_, joints_, stages_;
  std::mutex mutex_;
  Health health_;
  std::vector<double> processing_, delay_;  ///< [s] by frame
  std::vector<double> stage_seconds_;       ///< by stage, summed
  std::vector<int> seen_;                   ///< by target: frames with a pose
  std::vector<int> markers_;                ///< by target: summed
  int refused_ = 0;
  std::string last_refusal_;
};

}  // namespace mocap
}  // namespace anthrob
