#pragma once

#include <optional>
#include <string>
#include <vector>

#include "protocol.h"
#include "sample.h"

namespace anthrob {

/// One visit to a posture, step by step: from rest to the posture, hold, and back. Decides at every
/// instant where the robot must go and what is recorded; knows neither topics nor files.
///
/// - Equilibria: to rest | lead*1, sample | out*1 | hold*1, sample | back | hold, sample
/// - Trajectories:
///   to rest | lead*1, sample | out*1 | hold*1, sample | lead*2 | back*2 | hold*2, sample
/// - Zero gravity:
///   to rest | hold, sample | out | release*1 | hold*1, sample | back | hold, sample
/// - Zero gravity by hand: wait for the operator | settle*1 | hold*1, sample
///
/// *n: goes into the visit's n-th recording. Hold and lead last for a fixed time, the others until
/// the robot has settled.
class Visit {
 public:
  enum class Aim { kRest, kTarget, kRelease };
  enum class Outcome { kRunning, kDone, kDrifted, kFailed };
  struct Order {
    Aim aim;
    int recording;  ///< 0: none, 1, 2
  };

  /// @param baseline the first rest posture of the session, null if this visit finds it
  Visit(std::shared_ptr<const RobotModel> model, const Protocol& protocol, const Sample* baseline);

  /// @param time [s]   @return what to do until the next call
  Order step(const RobotMeasurement& measured, double time);
  /// The operator has set the posture. @return whether the visit was waiting for this
  bool trigger();
  /// Ends the visit because of an error that its steps cannot see. @param reason one line
  void fail(const std::string& reason);

  Outcome outcome() const { return outcome_; }
  /// Whether step has been called.
  bool begun() const { return at_ > 0 || begun_; }
  /// Of a failure or a drift, one line.
  const std::optional<std::string>& reason() const { return reason_; }
  /// The posture at rest before and after, and at the target; empty position: not sampled.
  const Sample& rest_before() const { return samples_[kBefore]; }
  const Sample& target() const { return samples_[kTarget]; }
  const Sample& rest_after() const { return samples_[kAfter]; }
  /// How far the rest posture was from the baseline, the worse of before and after [rad].
  double drift() const { return drift_; }
  double settling_time() const { return settling_time_; }  ///< on the way to the target [s]

  /// Number of recordings that a visit makes.
  static int recordings(const Protocol& protocol);

 private:
  enum SampleIndex { kNone = -1, kBefore, kTarget, kAfter };
  enum class End { kSettled, kElapsed, kTrigger };
  struct Step {
    const char* name;
    Aim aim;
    int recording;
    End end;
    SampleIndex sample;
  };

  static std::vector<Step> steps_of(const Protocol& protocol);
  void begin(double time);
  void finish_step(double time);
  void check_drift(const Sample& rest);
  /// How long a controller takes to get there [s]; 0 where references are sent directly.
  double duration_of(Aim aim) const;

  std::shared_ptr<const RobotModel> model_;
  const Protocol& protocol_;
  std::vector<Step> steps_;
  std::size_t at_ = 0;
  bool begun_ = false, triggered_ = false;
  double start_ = 0.0, settling_time_ = 0.0, drift_ = 0.0;
  SettleDetector settle_;
  SampleMean mean_;
  Sample samples_[3];
  Sample baseline_;
  Outcome outcome_ = Outcome::kRunning;
  std::optional<std::string> reason_;
};

}  // namespace anthrob
