#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "health/health_options.h"

namespace anthrob {
namespace health {

/// A part of the test [s].
struct Phase {
  enum class Kind { kMove, kSlack, kLevel, kFlank, kHold };
  Kind kind;
  double begin, end;
};

/// What is asked of the motors, from the model: all tendons at once are relaxed, tightened in
/// steps, slackened and tightened slowly, and held. Tensions balance each other and gravity in the
/// posture at the beginning, so that no joint moves far.
class TestProtocol {
 public:
  /// @param q posture at the beginning, size position_count
  /// @throws BadInput if the model has no tendon with a force sensor and a motor under position
  /// control, if something must hold the posture, or tensions cannot balance in it
  TestProtocol(const std::shared_ptr<const RobotModel>& model, const std::vector<double>& q,
               const HealthOptions& options);

  const RobotModel& model() const { return *model_; }
  const HealthOptions& options() const { return options_; }
  /// Indices of the tendons that are tested.
  const std::vector<int>& muscles() const { return muscles_; }
  const std::vector<Phase>& phases() const { return phases_; }
  double duration() const { return phases_.back().end; }  ///< [s]
  /// One per tested tendon [rad].   @param time since the beginning [s]
  std::vector<double> references(double time) const;
  /// "tightening in steps"
  static const char* words(Phase::Kind kind);
  const Phase& phase_at(double time) const;
  /// Tension in the middle of the reversal [N] and the wound length that the model has there [m],
  /// by tested tendon: where zeros and stiffness are compared.
  const std::vector<double>& middle_tension() const { return middle_tension_; }
  const std::vector<double>& middle_winding() const { return middle_winding_; }
  /// Tension that is asked for at most [N], by tested tendon.
  const std::vector<double>& highest_tension() const { return highest_tension_; }
  /// At the beginning, size position_count.
  const std::vector<double>& posture() const { return posture_; }
  /// Moment arms [m] of the tested tendons, by generalised velocity.
  const std::vector<std::vector<double>>& moment_arms() const { return moment_arms_; }
  /// The commands as a data set, every 5 ms, for a replay; its meta has the posture.
  Dataset commands() const;
  /// Notes the posture in the recording of a test, for posture_of().
  void note_posture(Dataset& recording) const;

 private:
  struct Knot {
    double time;
    std::vector<double> reference;
  };
  void go_to(const std::vector<double>& reference, double until, Phase::Kind kind);

  std::shared_ptr<const RobotModel> model_;
  HealthOptions options_;
  std::vector<int> muscles_;
  std::vector<Phase> phases_;
  std::vector<Knot> knots_;
  std::vector<double> posture_;
  std::vector<double> middle_tension_, middle_winding_, highest_tension_;
  std::vector<std::vector<double>> moment_arms_;
};

/// The posture in which a recorded test began: as noted in it, else the model's at rest.
/// @throws BadInput if what is noted is no posture of the model
std::vector<double> posture_of(const std::shared_ptr<const RobotModel>& model,
                               const Dataset& recording);

/// The first joint that has moved too far, as one line: "elbow: 2.4 degrees".
/// @param from,now postures, size position_count
std::optional<std::string> moved_too_far(const RobotModel& model, const std::vector<double>& from,
                                         const std::vector<double>& now, double largest);

}  // namespace health
}  // namespace anthrob
