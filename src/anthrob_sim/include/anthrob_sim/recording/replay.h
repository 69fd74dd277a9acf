#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/recording/dataset.h"
#include "anthrob_sim/recording/orientation_series.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// What of a recording drives the simulation.
enum class ReplayMode {
  kReference,  ///< commands, as followed_commands has them: the ECU's references
  kVoltage,    ///< recorded voltages, past the control law
  kPosition,   ///< recorded actuator positions are imposed
  kPosture,    ///< these and recorded joint positions are: only tendons and springs are simulated
};

/// Feeds a recording's inputs to simulations of one robot, whose numbers may differ: start() and
/// then a Run each. Inputs hold from their row to the next; imposed positions are interpolated.
/// Efforts and loads of hinges and prismatic joints are applied in every mode.
class Replay {
 public:
  /// @throws BadInput if the recording names muscles or joints that the robot lacks, or has no
  /// input, or one that is not a finite number or a known mode, or a unit followed what nobody
  /// commanded; of kPosture, a joint that was not measured. What was only measured may be NaN.
  Replay(std::shared_ptr<const RobotModel> model, const Dataset& recording, ReplayMode mode);

  /// Puts the simulation where the recording starts: settled at the references in force then, with
  /// motors that had none where they were measured; at zero; or at given positions, as the
  /// recording's meta.yaml says. Robots without muscles start at their first recorded joint
  /// positions; of kPosture all is at its first recorded position, whatever meta.yaml says. The
  /// recording's time 0 is now.
  ///
  /// Dry friction and cogging let a motor stand in many places, and by which way the recorded one
  /// came only its reading tells: motors under position control that end farther from where they
  /// were measured first than a count of their encoders, or than noise, but no farther than 1 rad,
  /// are led there in the last second of the settling, or its second half; not if it takes less
  /// than 0.5 s.
  void start(Simulation& sim) const { start(sim, settle(sim)); }
  /// States of a simulation that settles, which recordings of equal start_inputs() share.
  struct Settled {
    Snapshot late, last;  ///< when the last second begins; at the end
  };
  Settled settle(Simulation& sim) const;
  /// start() of a simulation that has settled before. @param sim of the same model
  void start(Simulation& sim, const Settled& settled) const;
  /// What settle() depends on beside the model.
  std::vector<double> start_inputs() const;

  /// Drives one simulation from the recording's start on.
  class Run;

  /// [s]
  double duration() const { return duration_; }

 private:
  struct MuscleInput {
    int muscle;
    Series mode, reference;  ///< as its unit followed them
    Series voltage, position, ecu_state;
    double blur;  ///< of the measured position: a count, or noise that is more [rad]
  };
  struct JointInput {
    int joint;
    Series effort, load, position;
  };
  struct BallInput {
    int joint;
    OrientationSeries turns;
  };

  /// What holds a muscle while the robot settles.
  struct StartInput {
    bool imposed;    ///< the actuator's position; else a command
    ecu::Mode mode;  ///< of the command
    double value;
  };
  StartInput start_input(const MuscleInput& input) const;
  /// A motor that does not stand where it was measured, and where within what is known of that it
  /// should [rad].
  struct Lead {
    int muscle;
    double position;
  };
  std::vector<Lead> leads_from(const Simulation& settled) const;
  long last_steps(const Simulation& sim) const;  ///< of the settling's last second

  /// First recorded positions: of joints, as in a configuration, and of muscles.
  struct RecordedStart {
    std::vector<double> q, positions;
  };
  RecordedStart recorded_start() const;
  void start_where_recorded(Simulation& sim, long steps) const;
  /// Efforts and loads of all joints: those that act when the recording begins, or none.
  void load_joints(Simulation& sim, bool as_recorded) const;

  void read_joint(const JointModel& joint, int index, const Dataset& recording);
  /// Recorded joint positions, between two rows on the straight way.
  void posture_at(double time, std::vector<double>& q) const;

  void check_names(const Dataset& recording) const;
  void check_inputs(const Dataset& recording) const;
  /// How much of a column drives the simulation.
  enum class Use { kNone, kStart, kAll };
  Use use_of(const Dataset& recording, const Column& column) const;
  ecu::Mode unsaid_mode(std::size_t muscle) const;

  std::shared_ptr<const RobotModel> model_;
  ReplayMode mode_;
  DatasetMeta meta_;
  std::vector<MuscleInput> muscles_;
  std::vector<JointInput> joints_;
  std::vector<BallInput> balls_;  ///< of kPosture only
  double duration_ = 0.0;
};

class Replay::Run {
 public:
  /// To be made after start().
  /// @param replay must outlive this   @param sim likewise; nobody else gives it inputs
  Run(const Replay& replay, Simulation& sim);

  /// Sets the inputs of the step from `time` [s] on, as far as they have changed. Times only go on.
  void drive(double time);

 private:
  struct MuscleRun {
    const MuscleInput* input;
    HeldSeries mode, reference, voltage, ecu_state;
  };
  struct JointRun {
    const JointInput* input;
    bool driven;
    HeldSeries effort, load;
  };
  void command(MuscleRun& muscle, double now);
  void impose(const MuscleInput& input, double time);

  const Replay& replay_;
  Simulation& sim_;
  std::vector<MuscleRun> muscles_;
  std::vector<JointRun> joints_;
  std::vector<double> posture_;  ///< scratch
};

/// Runs a whole recording and samples the simulation, with ideal sensors, at the recording's rows:
/// every file of the recording with its own columns, and what no file has in muscles.csv,
/// joints.csv and spherical_joints.csv. Between two steps values are interpolated.
/// @param progress called with the share done in [0, 1]; returns false to stop early (may be empty)
/// @param failure if given, gets what a NumericalFailure says instead of its being thrown
/// @return of a replay that was stopped or failed, the rows up to there; none if it failed before
/// the first. `cut_short` in its meta says up to when.
Dataset replay(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
               ReplayMode mode, const std::function<bool(double)>& progress = {},
               std::string* failure = nullptr);

}  // namespace anthrob
