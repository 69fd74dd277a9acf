#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// Reads one quantity off a running simulation, as ideal sensors would.
class Probe {
 public:
  /// @param column "<muscle>/force", "<joint>/position" etc.; the robot must have this quantity
  Probe(const RobotModel& model, const std::string& column);

  /// Index of the ball joint if the quantity is w, x, y or z of its orientation; else -1.
  int turn() const { return turn_; }
  /// Whether values may be interpolated between steps; false for words such as modes.
  bool interpolates() const;
  double read(const Simulation& sim) const;

 private:
  double read_muscle(const Simulation& sim) const;
  double read_joint(const Simulation& sim) const;

  std::string quantity_;
  int muscle_, joint_, turn_;
};

/// Fills a table from a simulation, row by row while it runs.
class TableSampler {
 public:
  /// @param table with times and names of columns   @param start the simulation's time 0
  TableSampler(const RobotModel& model, Table table, Nanoseconds start);

  /// To be called when the simulation has arrived at `time` [s]: fills the rows up to there, with
  /// values interpolated between steps.
  void sample(const Simulation& sim, double time);
  /// The rows that were filled.
  Table take();

 private:
  void find_turned_signs();

  Table table_;
  Nanoseconds start_;
  std::vector<Probe> probes_;
  std::vector<double> last_, now_;
  std::vector<char> turned_;  ///< numbers that must not be interpolated in this step
  std::size_t row_ = 0;
  double last_time_ = 0.0;
  bool first_ = true;
};

}  // namespace anthrob
