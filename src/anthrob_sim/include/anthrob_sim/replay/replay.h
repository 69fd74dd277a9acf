#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// What pushes a robot's links from `t` on, until the next row.
struct PushRow {
  double t;  ///< [s] since the start of the recording
  std::vector<Wrench> wrenches;
};

/// Which part of a recording drives the simulation.
enum class ReplayMode {
  kReference,  ///< commands, as followed_commands has them: the ECU's references
  kVoltage,    ///< recorded voltages, past the control law
  kPosition,   ///< recorded actuator positions are imposed
  kPosture,    ///< actuator and joint positions are imposed: only tendons and springs are simulated
};

/// Feeds the inputs of a recording to simulations of one robot, whose parameters may differ. For
/// each simulation call start() and then create a Run. Inputs hold from their row to the next;
/// imposed positions are interpolated. Efforts and loads of hinges and prismatic joints and pushes
/// of links are applied in every mode.
class Replay {
 public:
  /// @throws BadInput if the recording names muscles or joints that the robot does not have, has no
  /// input, has an input that is not finite or not a known mode, or if a unit followed a command
  /// that was not recorded; in mode kPosture also if a joint was not measured. Measurements that
  /// drive nothing may be NaN.
  Replay(std::shared_ptr<const RobotModel> model, const Dataset& recording, ReplayMode mode);

  /// Puts the simulation where the recording starts, as the recording's meta.yaml says: settled at
  /// the references in force then (motors without a reference stand where they were measured), at
  /// zero, or at given positions. Robots without muscles start at their first recorded joint
  /// positions. In mode kPosture everything starts at its first recorded position, whatever
  /// meta.yaml says. The recording's time 0 is the current time of the simulation.
  ///
  /// With dry friction and cogging, a motor can come to rest at many positions, and only the
  /// measurement says at which the recorded one did. So motors under position control are moved to
  /// their first measured position in the last second of the settling, or in its second half if it
  /// is shorter than 2 s. This is done if the motor would end farther from that position than one
  /// encoder count or the noise, but at most 1 rad away, and if the settling takes at least 0.5 s.
  /// Where the settling is too short for a motor to be wound to where it was measured, it is placed
  /// there at once.
  /// @param wanted asked every 1000 steps of the settling (may be empty); false stops it
  /// @return whether the simulation has started, false if it was stopped
  bool start(Simulation& sim, const std::function<bool()>& wanted = {}) const;
  /// States of a simulation that settles. Recordings with equal start_inputs() can share them.
  struct Settled {
    Snapshot late, last;   ///< at the beginning of the last second; at the end
    bool stopped = false;  ///< before the end
  };
  Settled settle(Simulation& sim, const std::function<bool()>& wanted = {}) const;
  /// start() of a simulation that has settled before. @param sim of the same model
  void start(Simulation& sim, const Settled& settled) const;
  /// Everything that settle() depends on, apart from the model.
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
    double position_uncertainty;  ///< one count, or the noise if that is larger [rad]
  };
  struct JointInput {
    int joint;
    Series effort, load, position;
  };
  struct BallInput {
    int joint;
    OrientationSeries turns;
  };

  /// Motion of a motor from one position to another [rad].
  struct Ramp {
    int muscle;
    double from, to;
  };
  static void ramp(Simulation& sim, const std::vector<Ramp>& ramps, long step, long steps);
  /// What holds a muscle while the robot settles.
  struct StartInput {
    bool imposed;    ///< the actuator's position; else a command
    ecu::Mode mode;  ///< of the command
    double value;
  };
  StartInput start_input(const MuscleInput& input) const;
  /// Target for a motor that settled away from its measured position: the nearest position within
  /// the measurement uncertainty [rad].
  struct RampTarget {
    int muscle;
    double position;
  };
  std::vector<RampTarget> ramp_targets(const Simulation& settled) const;
  long last_steps(const Simulation& sim) const;  ///< of the settling's last second

  /// First recorded positions: of joints, as in a configuration, and of muscles.
  struct RecordedStart {
    std::vector<double> q, positions;
  };
  RecordedStart recorded_start() const;
  /// @return false if it was stopped
  bool start_where_recorded(Simulation& sim, long steps, const std::function<bool()>& wanted) const;
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
  /// Mode of commands whose mode was not recorded.
  ecu::Mode default_mode(std::size_t muscle) const;

  std::shared_ptr<const RobotModel> model_;
  ReplayMode mode_;
  DatasetMeta meta_;
  std::vector<MuscleInput> muscles_;
  std::vector<JointInput> joints_;
  std::vector<BallInput> balls_;  ///< of kPosture, and of robots without muscles
  std::vector<PushRow> pushes_;
  double duration_ = 0.0;
};

class Replay::Run {
 public:
  /// To be created after start().
  /// @param replay must outlive this   @param sim must outlive this; must get no other inputs
  Run(const Replay& replay, Simulation& sim);

  /// Sets the inputs of the step that begins at `time` [s], as far as they have changed. Times must
  /// not decrease.
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
  /// For one step, as the last row says.
  void push(double now);
  void command(MuscleRun& muscle, double now);
  void impose(const MuscleInput& input, double time);

  const Replay& replay_;
  Simulation& sim_;
  std::vector<MuscleRun> muscles_;
  std::vector<JointRun> joints_;
  std::vector<double> posture_;  ///< scratch
  std::size_t next_push_ = 0;    ///< row of pushes that is still to come
};

/// Replays a whole recording and samples the simulation, with ideal sensors, at the recording's
/// rows. The result has all files and columns of the recording; quantities that it lacks are added
/// to muscles.csv, joints.csv and spherical_joints.csv. Values are interpolated between steps.
/// @param progress called with the share done in [0, 1], also while the robot settles; returns
/// false to stop early (may be empty)
/// @param failure if not null, gets the message of a NumericalFailure, which is then not thrown
/// @throws BadInput for what nobody can have measured: see refuse_implausible_values()
/// @return the simulated recording. If the replay was stopped or failed: the rows up to there (none
/// if it failed before the first), and `cut_short` in its meta says up to which time
Dataset replay(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
               ReplayMode mode, const std::function<bool(double)>& progress = {},
               std::string* failure = nullptr);

/// Commands to a muscle's motor unit over time. `mode` is empty if it was not recorded.
struct CommandSeries {
  Series mode, reference;
};

/// The commands that a muscle's unit actually followed. If the recording contains `ecu_state`,
/// together with the mode and reference in force, then commands that the unit refused or got while
/// it was not ENABLED are left out, and from each stop on the command is VOLTAGE 0 until a later
/// command. The series begins at time 0 if the recording says what was in force there.
/// @param default_mode mode of commands without a recorded mode
CommandSeries followed_commands(const Dataset& recording, const std::string& muscle,
                                ecu::Mode default_mode);

/// Checks that the recording contains every command that the unit followed.
/// @throws BadInput with the time, if the unit followed a command that was not recorded
void require_commanded(const Dataset& recording, const std::string& muscle,
                       const CommandSeries& followed);

/// Refuses numbers that nobody can have measured: positions far beyond a joint's stops (in degrees
/// or millimetres), tendons that push (a force sensor with the other sign).
/// @throws BadInput with file, row and column
void refuse_implausible_values(const RobotModel& robot, const Dataset& recording);

/// Refuses what is not finite, or beyond 1e9 in whatever unit. @throws BadInput as above
void refuse_no_numbers(const Dataset& recording);

/// @throws BadInput "FOLDER/TABLE.csv: row N: complaint", counted from 1
/// @param row counted from 0
[[noreturn]] void refuse_row(const Dataset& recording, const Table& table, std::size_t row,
                             const std::string& complaint);

}  // namespace anthrob
