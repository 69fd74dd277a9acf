#include "problem/measured_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/errors.h"
#include "anthrob_ecu/state_machine.h"
#include "anthrob_recording/orientation_series.h"
#include "anthrob_recording/quantities.h"
#include "anthrob_recording/unanswered.h"
#include "anthrob_sim/replay/replay.h"

namespace anthrob {
namespace calibration {

namespace fs = std::filesystem;

namespace {

/// What the recorder lets a measurement be late.
constexpr double kUnderWay = 0.05;  // [s]
/// Longer than any robot is left alone before a recording; more is a slip of the pen. [s]
constexpr double kLongestRest = 3600.0;

/// As its file or folder is called, a bag's without ".bag".
std::string name_of(const std::string& path) {
  const fs::path entry =
      fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path();
  return (entry.extension() == ".bag" ? entry.stem() : entry.filename()).string();
}

/// The columns of a recording that calibration needs, checked.
class RunReader {
 public:
  RunReader(const Dataset& recording, const std::shared_ptr<const RobotModel>& model,
            const SamplingOptions& options)
      : recording_(recording), model_(*model), options_(options) {
    if (recording.tables.empty() || recording.end() <= recording.begin()) {
      fail("fewer than two rows; expected a recording");
    }
    check_model();
    check_same_robot();
    const Replay names_are_known(model, recording, ReplayMode::kReference);
    check_start();
    for (const JointModel& joint : model_.skeleton->joints) check_loads(joint);
    for (const MuscleModel& muscle : model_.muscles) read_muscle(muscle.name);
    if (positions_.size() != references_.size()) positions_.clear();
    for (const JointModel& joint : model_.skeleton->joints) read_joint(joint);
    refuse_implausible_values(model_, recording);
  }

  MeasuredRun read() {
    MeasuredRun run;
    run.name = name_of(recording_.folder);
    read_kind(run);
    read_commands(run);
    check_states();
    const double from = run.is_trajectory ? std::max(0.0, origin_ - options_.average)
                                          : std::max(origin_, end_ - options_.average);
    for (const auto& [name, series] : measured_) check_gaps(name, series, from);
    run.settle = recording_.meta.settle_s;
    if (run.settle > kLongestRest) {
      fail("meta.yaml: start.settle_s: " + exact_text(run.settle) + " s: expected at most " +
           exact_text(kLongestRest) + " s, for the rest is simulated, too");
    }
    run.lead = std::max(0.0, origin_);
    run.duration = end_ - origin_;
    if (run.duration < options_.shortest) {
      fail("ends " + std::to_string(run.duration) +
           " s after its first command; expected at least " + std::to_string(options_.shortest) +
           " s");
    }
    run.after = mean_of(std::max(origin_, end_ - options_.average), end_);
    if (!run.is_trajectory) return run;
    run.before = mean_of(std::max(0.0, origin_ - options_.average), origin_);
    const int count = static_cast<int>(std::floor(run.duration * options_.rate + 1e-6)) + 1;
    std::vector<double> times;
    for (int i = 0; i < count; ++i) times.push_back(i / options_.rate);
    run.path = samples_at(times);
    return run;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw BadInput(recording_.folder + ": " + message);
  }

  void check_model() const {
    if (model_.muscles.empty()) {
      throw BadInput(model_.file +
                     ": has no muscles; calibration needs muscles under position control");
    }
    for (const MuscleModel& muscle : model_.muscles) {
      if (muscle.has_controller) continue;
      throw BadInput(model_.file + ": muscles." + muscle.name +
                     ": has no controller; calibration needs a motor under position control at "
                     "each muscle");
    }
  }

  /// All runs are simulated with one model, some of them one after the other.
  void check_same_robot() const {
    if (recording_.meta.model.empty()) return;
    const auto& [path, value] = *recording_.meta.model.begin();
    fail("meta.yaml: model." + path + ": " + exact_text(value) +
         ": calibration simulates one robot in all recordings; expected none, and a model file "
         "that extends " +
         model_.file + " by these numbers for the recordings that have them");
  }

  /// A replay leaves motors that are not named without voltage; calibration only knows motors that
  /// hold a position.
  void check_start() const {
    const auto& given = recording_.meta.start_position;
    if (given.empty()) return;
    for (const MuscleModel& muscle : model_.muscles) {
      if (given.count(muscle.name)) continue;
      fail("meta.yaml: start.reference: " + muscle.name +
           " is not named; expected the reference of every muscle");
    }
  }

  /// Calibration simulates a robot that nothing but its motors moves.
  void check_loads(const JointModel& joint) const {
    for (const char* quantity : {"/load", "/effort"}) {
      if (quantity == std::string("/effort") && !joint.driven) continue;
      for (const double value : recording_.series(joint.name + quantity).values) {
        if (value == 0.0) continue;
        fail(joint.name + quantity + ": " + exact_text(value) +
             ": expected 0; calibration simulates motors of muscles only");
      }
    }
  }

  Series column(const std::string& name, bool required = true) const {
    Series series = recording_.series(name);
    if (series.empty() && required) fail("column '" + name + "' is missing or empty");
    for (std::size_t i = 0; i < series.values.size(); ++i) {
      if (!std::isfinite(series.values[i])) fail_not_finite(name, series.t[i]);
    }
    return series;
  }

  [[noreturn]] void fail_not_finite(const std::string& name, double t) const {
    fail(name + ": not a finite number at t = " + std::to_string(t) + " s");
  }

  Series measured(const std::string& name, bool required = true) {
    Series series = column(name, required);
    if (series.empty()) return series;
    end_ = std::min(end_, series.t.back());
    last_ = std::max(last_, series.t.back());
    measured_.emplace_back(name, series);
    return series;
  }

  /// What lies between two samples is taken as a line: not for longer than a sensor may be silent.
  /// @param from what is sampled begins there; it ends with the recording
  void check_gaps(const std::string& name, const Series& series, double from) const {
    if (series.t.size() < 2) return;  // a mean, maybe of much
    std::vector<double> periods;
    for (std::size_t i = 1; i < series.t.size(); ++i) {
      periods.push_back(series.t[i] - series.t[i - 1]);
    }
    const auto middle = periods.begin() + static_cast<long>(periods.size() / 2);
    std::nth_element(periods.begin(), middle, periods.end());
    const double allowed = std::max(kLongestLoss, 2.0 * *middle);
    const auto check = [&](double begin, double end) {
      if (end <= from || end - begin <= allowed + 1e-6) return;
      fail(name + ": nothing measured from t = " + std::to_string(begin) + " to " +
           std::to_string(end) + " s: expected no gap of more than " + std::to_string(allowed) +
           " s");
    };
    check(from, series.t.front());
    for (std::size_t i = 1; i < series.t.size(); ++i) check(series.t[i - 1], series.t[i]);
    // Samples end where the first sensor ends; one that is late has more under way.
    if (last_ - series.t.back() > kUnderWay) check(series.t.back(), last_ - kUnderWay);
  }

  void read_muscle(const std::string& name) {
    for (const double mode : column(name + "/mode", false).values) {
      if (mode != static_cast<double>(ecu::Mode::kPosition)) {
        fail(name + "/mode: " + word_of("mode", static_cast<int>(mode)) +
             ": expected POSITION; calibration can only use position control");
      }
    }
    column(name + "/reference");
    read_references(name);
    forces_.push_back(measured(name + "/force"));
    Series position = measured(name + "/position", false);
    if (!position.empty()) positions_.push_back(std::move(position));
  }

  /// Where a recording tells what its units did, the references that they followed.
  void read_references(const std::string& name) {
    CommandSeries told = followed_commands(recording_, name, ecu::Mode::kPosition);
    const auto holds_position = [&](std::size_t i) {
      return told.mode.empty() ||
             told.mode.held_at(told.reference.t[i]) == static_cast<double>(ecu::Mode::kPosition);
    };
    Series held;
    for (std::size_t i = 0; i < told.reference.t.size(); ++i) {
      if (!holds_position(i)) continue;  // without voltage: check_states() says more of it
      held.t.push_back(told.reference.t[i]);
      held.values.push_back(told.reference.values[i]);
    }
    if (held.empty()) fail(name + "/reference: its ECU did not follow any command");
    begins_held_.push_back(holds_position(0) ? 1 : 0);
    references_.push_back(std::move(held));
  }

  void read_joint(const JointModel& joint) {
    if (joint.type != JointType::kBall) {
      q_.push_back(measured(joint.name + "/position"));
      return;
    }
    for (const char* axis : {"w", "x", "y", "z"}) measured(joint.name + "/" + axis);
    OrientationSeries turns = OrientationSeries::read(recording_, joint.name);
    for (Series& number : turns.number) q_.push_back(std::move(number));
  }

  void read_kind(MeasuredRun& run) const {
    const std::string& kind = recording_.meta.kind;
    if (kind != "equilibrium" && kind != "trajectory") {
      fail("meta.yaml: kind: " + kind + ": expected equilibrium or trajectory");
    }
    run.is_trajectory = kind == "trajectory";
  }

  void read_commands(MeasuredRun& run) {
    std::set<double> changes;
    for (std::size_t m = 0; m < references_.size(); ++m) {
      const Series& reference = references_[m];
      run.start.push_back(start_reference(m));
      if (run.start.back() != reference.values.front()) changes.insert(reference.t.front());
      for (std::size_t i = 1; i < reference.t.size(); ++i) {
        if (reference.values[i] != reference.values[i - 1]) changes.insert(reference.t[i]);
      }
    }
    // A run to where the robot is already.
    if (changes.empty()) changes.insert(references_.front().t.front());
    origin_ = *changes.begin();
    for (const double t : changes) {
      Command command{t - origin_, {}};
      for (std::size_t m = 0; m < references_.size(); ++m) {
        const Series& reference = references_[m];
        const bool told = t >= reference.t.front();
        command.reference.push_back(told ? reference.held_at(t) : run.start[m]);
      }
      run.commands.push_back(command);
    }
  }

  /// Motors that are stopped do not follow the references that a simulated run follows.
  void check_states() const {
    constexpr auto kEnabled = static_cast<double>(ecu::State::kEnabled);
    for (const MuscleModel& muscle : model_.muscles) {
      const Series states = recording_.series(muscle.name + "/ecu_state");
      for (std::size_t i = 0; i < states.t.size(); ++i) {
        if (states.t[i] <= origin_ || states.t[i] > end_ || states.values[i] == kEnabled) continue;
        fail(muscle.name +
             "/ecu_state: " + word_of("ecu_state", static_cast<int>(states.values[i])) +
             " at t = " + std::to_string(states.t[i]) +
             " s: expected ENABLED from the first command to the end; end the recording before "
             "that time");
      }
    }
  }

  double start_reference(std::size_t muscle) const {
    if (recording_.meta.start == "first") {
      if (!begins_held_[muscle]) {
        fail(model_.muscles[muscle].name +
             ": had no voltage when the recording began, so its reference at rest is unknown; cut "
             "off the beginning, or state the references in meta.yaml as start.reference");
      }
      return references_[muscle].values.front();
    }
    const auto given = recording_.meta.start_position.find(model_.muscles[muscle].name);
    return given == recording_.meta.start_position.end() ? 0.0 : given->second;
  }

  Samples empty(std::size_t rows) const {
    Samples samples;
    const auto count = static_cast<Eigen::Index>(rows);
    samples.q.setZero(count, static_cast<Eigen::Index>(q_.size()));
    samples.force.setZero(count, static_cast<Eigen::Index>(forces_.size()));
    samples.position.setZero(count, static_cast<Eigen::Index>(positions_.size()));
    return samples;
  }

  Samples samples_at(const std::vector<double>& times) const {
    Samples samples = empty(times.size());
    samples.t = times;
    const auto fill = [&](const std::vector<Series>& columns, Eigen::MatrixXd& out) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        for (std::size_t i = 0; i < times.size(); ++i) {
          out(static_cast<long>(i), static_cast<long>(c)) = columns[c].at(origin_ + times[i]);
        }
      }
    };
    fill(q_, samples.q);
    fill(forces_, samples.force);
    fill(positions_, samples.position);
    return samples;
  }

  /// Mean over an interval in which the robot stands still. Quaternions that are close together may
  /// be averaged as vectors; comparing normalises them.
  Samples mean_of(double from, double to) const {
    constexpr int kPoints = 21;
    std::vector<double> times;
    for (int i = 0; i < kPoints; ++i)
      times.push_back(from + (to - from) * i / (kPoints - 1) - origin_);
    const Samples all = samples_at(times);
    Samples mean = empty(1);
    mean.t = {0.5 * (from + to) - origin_};
    mean.window = to - from;
    mean.q = all.q.colwise().mean();
    mean.force = all.force.colwise().mean();
    mean.position = all.position.colwise().mean();
    const auto measurements = [&](const std::vector<Series>& columns) {
      double least = kPoints;
      for (const Series& column : columns) {
        const auto begin = std::lower_bound(column.t.begin(), column.t.end(), from - 1e-9),
                   end = std::upper_bound(column.t.begin(), column.t.end(), to + 1e-9);
        least = std::min(least, static_cast<double>(end - begin));
      }
      return std::max(1.0, least);
    };
    mean.posture_measurements = measurements(q_);
    mean.force_measurements = measurements(forces_);
    return mean;
  }

  const Dataset& recording_;
  const RobotModel& model_;
  const SamplingOptions& options_;
  std::vector<Series> references_, forces_, positions_, q_;
  std::vector<char> begins_held_;  ///< of each muscle, whether its motor had a reference then
  std::vector<std::pair<std::string, Series>> measured_;
  double origin_ = 0.0, end_ = HUGE_VAL, last_ = 0.0;
};

}  // namespace

MeasuredRun read_run(const Dataset& recording, const std::shared_ptr<const RobotModel>& model,
                     const SamplingOptions& options) {
  return RunReader(recording, model, options).read();
}

std::vector<MeasuredRun> read_runs(const std::vector<Dataset>& recordings,
                                   const std::shared_ptr<const RobotModel>& model,
                                   const SamplingOptions& options) {
  std::vector<MeasuredRun> runs;
  std::map<std::uint64_t, std::string> known;
  for (Dataset recording : recordings) {
    const auto [same, is_new] =
        known.emplace(resume::content_fingerprint(recording), recording.folder);
    if (!is_new) {
      throw BadInput(recording.folder + ": the same recording as " + same->second +
                     "; expected every recording once");
    }
    leave_out_unanswered(recording);
    runs.push_back(read_run(recording, model, options));
    runs.back().remarks = recording.remarks;
    runs.back().content = same->first;
  }
  return runs;
}

}  // namespace calibration
}  // namespace anthrob
