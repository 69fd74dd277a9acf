#pragma once

#include "anthrob_sim/replay/replay.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// What drives the replay of a recording: the earliest input of the chain that it has.
ReplayMode mode_of(const RobotModel& model, const Dataset& recording);

/// A recording of a robot with muscles: its inputs are replayed through the whole chain, and the
/// simulated sensors, without noise and counts, are compared with the measured ones.
class ChainExperiment final : public Experiment {
 public:
  ChainExperiment(const RobotModel& model, const Dataset& recording,
                  const ExperimentOptions& options, const ReplayScope& scope);

  void settle(const std::shared_ptr<const RobotModel>& model, Starts& starts) const override;
  void compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
               float* out) const override;

 private:
  /// A quantity of the simulation that was measured.
  struct Reader {
    enum Kind { kPosition, kCurrent, kVoltage, kForce, kJoint, kBall } kind;
    int index;                                    ///< of the muscle or joint
    std::size_t offset;                           ///< of its (first) channel
    std::vector<double> mean;                     ///< measured, by bin; not of ball joints
    std::vector<std::array<double, 4>> rotation;  ///< measured, by row; of ball joints
    double noise = 0.0;  ///< standard deviation, of forces that were cut off at zero [N]
  };
  /// Readers whose samples were taken at the same times.
  struct Sampling {
    struct Row {
      double time;  ///< [s]
      std::uint32_t bin;
    };
    std::vector<Row> rows;
    std::vector<double> per_bin;  ///< 1 / rows in it, or 0
    std::vector<Reader> readers;

    double rows_per_bin() const;  ///< harmonic mean over bins with any
  };

  std::size_t bin_of(double time) const;
  Sampling& sampling_of(const std::vector<double>& times);
  void add(Reader reader, const Series& series, const Channel& channel);
  void add_ball(int joint, const std::string& name, const Dataset& recording);
  /// @param share of `now`, less that of `before`, in the state at the row's time
  void finish_row(const Sampling& sampling, std::size_t row, double share,
                  const std::vector<double>& before, const std::vector<double>& now,
                  float* out) const;
  static void read(const Simulation& sim, const Sampling& sampling, std::vector<double>& values);

  CutOffOptions cut_off_;
  double rounding_;
  ReplayMode mode_;
  Replay input_;
  std::size_t bins_;
  std::vector<std::vector<double>> times_;  ///< of each sampling
  std::vector<Sampling> samplings_;
};

}  // namespace discovery
}  // namespace anthrob
