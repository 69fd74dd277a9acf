#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/replay/replay.h"
#include "options/experiment.h"

namespace anthrob {
namespace discovery {

/// Quantity of driven joints in poses. Its floor is not that of efforts in motion.
inline const char* const kEffortAtRest = "effort_at_rest";

/// One measured quantity in one recording, averaged over short bins of time. An orientation is
/// three of them: the rotation from measured to simulated, as a vector in the child's axes.
struct Channel {
  std::string place;     ///< muscle or joint
  std::string quantity;  ///< position, current, voltage, force, orientation, effort
  std::string unit;
  int component = 0;                  ///< of an orientation: 0, 1, 2
  std::size_t offset = 0, count = 0;  ///< its bins in the vector of differences
  double resolution = 0.0;            ///< one count of its sensor; 0: none to be seen
  double rows = 1.0;                  ///< measurements in a bin (harmonic mean)
  double digits = 0.0;                ///< step of its file's last digits; 0: they are many
  double rounding = 0.0;  ///< power of two to whose multiples differences are rounded; 0: none

  std::string name() const { return place + "/" + quantity; }
  /// In which it was recorded.
  std::string column() const {
    return place + "/" + (quantity == kEffortAtRest ? "effort" : quantity);
  }
};

/// Settled states of one model, by what they depend on (Replay::start_inputs()): recordings that
/// start alike settle once.
using Starts = std::map<std::vector<double>, Replay::Settled>;

/// A recording as something to compare models with. Immutable; used by many threads.
class Experiment {
 public:
  virtual ~Experiment() = default;

  const std::string& name() const { return name_; }
  const std::vector<Channel>& channels() const { return channels_; }
  /// Length of the vector of differences.
  std::size_t size() const { return present_.size(); }
  /// Whether anything was measured in a bin.
  const std::vector<char>& present() const { return present_; }
  /// Whether a bin shows how the channel scatters: a joint that friction holds shows nothing.
  const std::vector<char>& telling() const { return telling_.empty() ? present_ : telling_; }
  /// Driven joints whose inertia does not count; see AxisPlan.
  const std::vector<int>& hidden_inertia() const { return hidden_inertia_; }
  /// Numbers of the model file that were others in this recording, by key path.
  const std::map<std::string, double>& known_numbers() const { return known_numbers_; }
  double bin() const { return bin_; }            ///< [s]
  double duration() const { return duration_; }  ///< [s]
  /// Of the recording and how it is replayed.
  std::uint64_t fingerprint() const { return fingerprint_; }
  /// Middle of a bin, or time of a pose.
  double bin_time(std::size_t bin) const {
    return (static_cast<double>(bin) + (of_poses_ ? 0.0 : 0.5)) * bin_;
  }
  /// Whether its bins are poses, whose times only put them in order (ordered_poses()).
  bool of_poses() const { return of_poses_; }

  /// Adds the settled state that compare() begins with, if there is one and it is not there yet.
  /// @param model with known_numbers()   @param starts of this model   @throws NumericalFailure
  virtual void settle(const std::shared_ptr<const RobotModel>&, Starts&) const {}
  /// Simulated minus measured, channel after channel; 0 where nothing was measured.
  /// @param model, starts as settle() got and left them   @param out size()   @throws
  /// NumericalFailure
  virtual void compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
                       float* out) const = 0;

 protected:
  std::string name_;
  double bin_ = 0.0, duration_ = 0.0;
  bool of_poses_ = false;
  std::uint64_t fingerprint_ = 0;
  std::vector<Channel> channels_;
  std::vector<char> present_;
  std::vector<char> telling_;  ///< empty: all that are present
  std::vector<int> hidden_inertia_;
  std::map<std::string, double> known_numbers_;
};

using Experiments = std::vector<std::shared_ptr<const Experiment>>;

double total_duration(const Experiments& experiments);  ///< [s]
/// Channels of all experiments, each once, in order of first appearance. A recording need not have
/// all of them.
std::vector<Channel> channels_of(const Experiments& experiments);
/// The same channel in one experiment; null if it is not there.
const Channel* find_channel(const Experiment& experiment, const Channel& channel);

/// What of a recording is replayed, and how finely it is compared.
struct ReplayScope {
  double bin = 0.02;  ///< [s]
  /// Which quantity is fed with measured values; by default the earliest recorded input of the
  /// chain.
  std::optional<ReplayMode> mode = {};
  double seconds = std::numeric_limits<double>::infinity();  ///< used, from the beginning
  std::vector<int> hidden_inertia = {};                      ///< driven joints; see AxisPlan
};

/// Replays all of a recording's commands, the whole chain from the controllers on. Robots whose
/// joints are driven from outside are compared bin by bin instead (see axis_experiment.h), or pose
/// by pose (see pose_experiment.h).
/// @throws BadInput if there is nothing to replay or to compare
std::shared_ptr<const Experiment> make_experiment(const RobotModel& model, const Dataset& recording,
                                                  const ExperimentOptions& options,
                                                  const ReplayScope& scope = {});

}  // namespace discovery
}  // namespace anthrob
