#include "problem/run_simulation.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>

#include "optimiser/journal.h"

namespace anthrob {
namespace calibration {

namespace {

/// Steps of a simulation between two questions whether to stop: far less than a second of work.
constexpr int kAsked = 1000;

void ask(const Stop& stop) {
  if (stop && stop()) throw Interrupted();
}

void advance(Simulation& sim, int steps, const Stop& stop) {
  for (int left = steps; left > 0; left -= kAsked) {
    ask(stop);
    sim.step(std::min(left, kAsked));
  }
}

/// By how much the model's sensor of a motor's position lags behind it [s].
double sensor_lag(const RobotModel& model, int muscle) {
  const SensorModel& sensor = model.sensors.position;
  const double tick = model.step * model.muscles[static_cast<std::size_t>(muscle)].steps_per_tick;
  return sensor.delay + 0.5 * (sensor.average - 1) * tick;
}

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Fills rows of differences from a running simulation; a row may be a mean over several steps.
class Comparison {
 public:
  Comparison(const RobotModel& model, const Samples& measured, int rows)
      : model_(model),
        measured_(measured),
        seen_(static_cast<std::size_t>(model.skeleton->position_count)),
        now_(model.skeleton->velocity_count) {
    posture_.setZero(rows, model.skeleton->velocity_count);
    differences.joints = static_cast<int>(model.skeleton->joints.size());
    differences.force.setZero(rows, static_cast<Eigen::Index>(model.muscles.size()));
    differences.actuator.setZero(rows, measured.position.cols());
  }

  void add(const Simulation& sim, int row, double weight = 1.0) {
    const Eigen::VectorXd q = measured_.q.row(row);
    see_posture(sim);
    posture_row(*model_.skeleton, q.data(), seen_.data(), now_.data());
    posture_.row(row) += weight * now_;
    for (Eigen::Index m = 0; m < differences.force.cols(); ++m) {
      const ecu::Measurement& reading = sim.muscle(static_cast<int>(m)).measured();
      differences.force(row, m) += weight * (reading.force - measured_.force(row, m));
      if (differences.actuator.cols() > 0) {
        differences.actuator(row, m) += weight * (reading.position - measured_.position(row, m));
      }
    }
  }

  Differences take() {
    differences.posture = posture_;
    return std::move(differences);
  }

 private:
  /// As the model's sensors see it.
  void see_posture(const Simulation& sim) {
    std::copy_n(sim.read_positions(), seen_.size(), seen_.begin());
    const auto& joints = model_.skeleton->joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      if (joints[j].type == JointType::kBall) continue;
      seen_[joints[j].position_offset] = sim.measured_joint_position(static_cast<int>(j));
    }
  }

  const RobotModel& model_;
  const Samples& measured_;
  std::vector<double> seen_;
  RowMatrix posture_;
  Eigen::RowVectorXd now_;
  Differences differences;
};

Differences compare_once(const Simulation& sim, const Samples& measured) {
  if (measured.count() == 0) return {};
  Comparison comparison(sim.model(), measured, 1);
  comparison.add(sim, 0);
  return comparison.take();
}

void command_positions(Simulation& sim, const std::vector<double>& reference) {
  for (std::size_t m = 0; m < reference.size(); ++m) {
    sim.command(static_cast<int>(m), ecu::Mode::kPosition, reference[m]);
  }
}

std::vector<double> row_of(const Eigen::MatrixXd& matrix, int row) {
  const Eigen::VectorXd values = matrix.row(row);
  return {values.data(), values.data() + values.size()};
}

/// Gives the inputs of a run to a simulation, step by step.
class Driver {
 public:
  Driver(const MeasuredRun& run, Drive drive) : run_(run), drive_(drive) {
    if (drive != Drive::kReferences && run.after.position.cols() == 0) {
      throw BadInput(run.name + ": actuator positions were not measured");
    }
  }

  void apply(Simulation& sim, double time) {
    switch (drive_) {
      case Drive::kReferences:
        for (; next_ < run_.commands.size() && run_.commands[next_].t <= time + 1e-9; ++next_) {
          command_positions(sim, run_.commands[next_].reference);
        }
        break;
      case Drive::kFinalPositions:
        if (next_++ == 0) command_positions(sim, row_of(run_.after.position, 0));
        break;
      case Drive::kSampledPositions:
        follow_samples(sim, time + sim.step_length());
        break;
    }
  }

 private:
  void follow_samples(Simulation& sim, double time) const {
    const Samples& path = run_.path;
    if (path.count() < 2) return;
    const double rate = 1.0 / (path.t[1] - path.t[0]);
    const auto last = static_cast<double>(path.count() - 1);
    const auto at = [&](Eigen::Index m, double t) {
      const double place = std::clamp(t * rate, 0.0, last - 1e-9);
      const auto row = static_cast<Eigen::Index>(place);
      const double from = path.position(row, m), to = path.position(row + 1, m);
      return from + (place - static_cast<double>(row)) * (to - from);
    };
    for (Eigen::Index m = 0; m < path.position.cols(); ++m) {
      const auto muscle = static_cast<int>(m);
      const double due =
          time + sim.muscle_inputs().position_delay(muscle) + sensor_lag(sim.model(), muscle);
      sim.muscle_inputs().impose_reading(muscle, at(m, due - sim.step_length()), at(m, due));
    }
  }

  const MeasuredRun& run_;
  Drive drive_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<Chain> chains_of(const std::vector<MeasuredRun>& runs) {
  std::map<std::vector<double>, int> starts;
  for (const MeasuredRun& run : runs) ++starts[run.start];
  if (runs.empty()) return {};
  // Of several at which as many start, the first run's: one goes there before one comes back.
  const auto& home = std::max_element(runs.begin(), runs.end(), [&](const auto& a, const auto& b) {
                       return starts.at(a.start) < starts.at(b.start);
                     })->start;
  std::vector<Chain> chains;
  std::vector<std::size_t> others;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (runs[r].start == home) {
      chains.push_back({{static_cast<int>(r)}, true});
    } else {
      others.push_back(r);
    }
  }
  const auto leads_to = [&](std::size_t before, std::size_t after) {
    return runs[before].commands.back().reference == runs[after].start;
  };
  // A run may follow one that is attached later than itself.
  const auto attach = [&](std::size_t r) {
    const auto before = std::find_if(chains.begin(), chains.end(), [&](const Chain& chain) {
      return leads_to(static_cast<std::size_t>(chain.runs.back()), r);
    });
    if (before != chains.end()) before->runs.push_back(static_cast<int>(r));
    return before != chains.end();
  };
  while (!others.empty()) {
    const std::size_t left = others.size();
    others.erase(std::remove_if(others.begin(), others.end(), attach), others.end());
    if (others.size() < left) continue;
    // One that none of the others leads to begins a chain; the first one where they go in circles.
    auto begin = std::find_if(others.begin(), others.end(), [&](std::size_t r) {
      return std::none_of(others.begin(), others.end(),
                          [&](std::size_t before) { return before != r && leads_to(before, r); });
    });
    if (begin == others.end()) begin = others.begin();
    chains.push_back({{static_cast<int>(*begin)}, false});
    others.erase(begin);
  }
  return chains;
}

void stand_at_start(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options) {
  const std::size_t muscles = sim.muscle_count();
  sim.place(sim.model().skeleton->rest_configuration(), std::vector<double>(muscles, 0.0));
  const bool by_reference = options.drive == Drive::kReferences || run.before.position.cols() == 0;
  command_positions(sim, by_reference ? run.start : row_of(run.before.position, 0));
}

int steps_of_rest(const Simulation& sim, const MeasuredRun& run, const SimulationOptions& options) {
  const double rest = std::min(options.settle, run.settle + run.lead);
  return static_cast<int>(std::lround(rest / sim.step_length()));
}

void wait_for_command(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options,
                      const Stop& stop) {
  const double rest = std::min(options.settle, run.lead);
  advance(sim, static_cast<int>(std::lround(rest / sim.step_length())), stop);
}

RunDifferences follow(Simulation& sim, const MeasuredRun& run, const SimulationOptions& options,
                      const Stop& stop) {
  RunDifferences result;
  result.before = compare_once(sim, run.before);
  const double h = sim.step_length();
  const auto steps_until = [&](double t) {
    return static_cast<int>(std::lround(std::min(options.motion, t) / h));
  };
  const int steps = steps_until(run.duration);
  // What was measured at the end is a mean; what was simulated is the mean over as long.
  const int last = steps_until(run.after.t.front() + 0.5 * run.after.window);
  const int count = std::min(last, static_cast<int>(std::lround(run.after.window / h))) + 1;
  int rows = 0;
  const auto due = [&](int row) { return static_cast<int>(std::lround(run.path.t[row] / h)); };
  while (rows < run.path.count() && due(rows) <= steps) ++rows;

  Comparison path(sim.model(), run.path, rows), after(sim.model(), run.after, 1);
  Driver driver(run, options.drive);
  int row = 0;
  for (int step = 0; step <= steps; ++step) {
    for (; row < rows && due(row) <= step; ++row) path.add(sim, row);
    if (step > last - count && step <= last) after.add(sim, 0, 1.0 / count);
    if (step == steps) break;
    if (step % kAsked == 0) ask(stop);
    driver.apply(sim, step * h);
    sim.step();
  }
  if (rows > 0) result.path = path.take();
  result.after = after.take();
  // What follows begins where this ended.
  if (options.drive == Drive::kSampledPositions) {
    command_positions(sim, row_of(run.after.position, 0));
  }
  for (std::size_t m = 0; m < sim.muscle_count(); ++m)
    sim.muscle_inputs().release(static_cast<int>(m));
  return result;
}

namespace {

/// The robot at home after as many steps of rest as each run had: rings and friction remember.
std::map<int, Snapshot> settle_at_home(const std::shared_ptr<const RobotModel>& model,
                                       const std::vector<MeasuredRun>& runs,
                                       const std::vector<Chain>& chains,
                                       const SimulationOptions& options, const Stop& stop) {
  std::map<int, Snapshot> homes;
  Simulation sim(model);
  for (const Chain& chain : chains) {
    if (!chain.from_home) continue;
    const MeasuredRun& first = runs[chain.runs.front()];
    if (homes.empty()) stand_at_start(sim, first, options);
    homes.try_emplace(steps_of_rest(sim, first, options));
  }
  int done = 0;
  for (auto& [steps, home] : homes) {
    advance(sim, steps - done, stop);
    done = steps;
    home = sim.snapshot();
  }
  return homes;
}

}  // namespace

std::vector<RunDifferences> simulate_runs(const std::shared_ptr<const RobotModel>& robot,
                                          const std::vector<MeasuredRun>& runs,
                                          const SimulationOptions& options, const Stop& stop) {
  const auto model = std::make_shared<RobotModel>(*robot);
  model->sensors = robot->sensors.predictable();
  const std::vector<Chain> chains = chains_of(runs);
  const std::map<int, Snapshot> homes = settle_at_home(model, runs, chains, options, stop);
  std::vector<RunDifferences> results(runs.size());
  std::vector<std::exception_ptr> failures(chains.size());
  tbb::parallel_for(std::size_t{0}, chains.size(), [&](std::size_t c) {
    try {
      Simulation sim(model);
      const MeasuredRun& first = runs[chains[c].runs.front()];
      if (chains[c].from_home) {
        sim.restore(homes.at(steps_of_rest(sim, first, options)));
      } else {
        stand_at_start(sim, first, options);
        advance(sim, steps_of_rest(sim, first, options), stop);
      }
      for (const int r : chains[c].runs) {
        if (r != chains[c].runs.front()) wait_for_command(sim, runs[r], options, stop);
        results[r] = follow(sim, runs[r], options, stop);
      }
    } catch (...) {
      failures[c] = std::current_exception();
    }
  });
  // The first one by place, not by time.
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  return results;
}

}  // namespace calibration
}  // namespace anthrob
