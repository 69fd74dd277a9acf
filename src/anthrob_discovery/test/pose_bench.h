#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <string>

#include "driven_bench.h"

namespace anthrob {
namespace discovery {

/// An arm that hangs on a bench, at rest in poses that come in no order, by its closed equation:
///   gain effort + load = weight sin(q) + direction coulomb
struct PoseBench {
  double weight = 2.0;   ///< [Nm] m g l, as the model has it
  double hidden = 0.0;   ///< [Nm] more of it
  double known = 0.0;    ///< [Nm] more of it in one recording, which says so
  double coulomb = 0.0;  ///< [Nm]
  double gain = 1.0;     ///< effort that acts over the recorded one
  double noise = 0.01;   ///< [Nm] of the effort
  int poses = 40;
  bool weighed = false;    ///< whether the model has an entry for `known`
  bool directions = true;  ///< whether the recording tells them
  double load = 0.0;       ///< [Nm] that is recorded

  static constexpr double kArm = 0.1, kGravity = 9.81;

  Dataset record(std::uint64_t seed) const {
    Dataset data;
    data.folder = "poses_" + std::to_string(seed);
    data.meta.robot = "bench";
    data.meta.kind = "equilibrium";
    if (known != 0.0) data.meta.model = {{"effects.0.mass", known / kGravity / kArm}};
    Table& table = data.table("joints");
    for (const char* quantity : {"position", "effort", "load", "direction"}) {
      table.column(std::string("axis/") + quantity);
    }
    const CounterRandom random(seed, 57);
    for (int i = 0; i < poses; ++i) {
      const auto k = static_cast<std::uint64_t>(i);
      // Even steps, from both sides, shuffled.
      const int half = poses / 2, level = 7 * i % half;
      const double side = i < half ? 1.0 : -1.0;
      const double q = 2.8 * level / (half - 1) - 1.4 + 0.02 * static_cast<double>(seed);
      const double needed = (weight + hidden + known) * std::sin(q) + side * coulomb - load;
      table.t.push_back(static_cast<Nanoseconds>(i) * 1000000000);
      table.columns[0].values.push_back(q + 0.01 * noise * random.normal(5000 + k));
      table.columns[1].values.push_back(needed / gain + noise * random.normal(1000 + k));
      table.columns[2].values.push_back(load);
      table.columns[3].values.push_back(side);
    }
    for (Column& column : table.columns) column.present.assign(table.t.size(), 1);
    if (!directions) table.columns.pop_back();
    return data;
  }

  /// Where recordings know a weight, with an entry for it at the centre of mass.
  std::string model() const {
    DrivenBench bench;
    bench.inertia = 0.05;
    bench.gravity = weight;
    const std::string file = bench.model();
    if (weighed) {
      std::ofstream(file, std::ios::app) << "effects: [{id: payload, place: rotor, mass: 0.0}]\n";
    }
    return file;
  }

  Question question() const {
    Question question;
    question.model_file = model();
    question.nuisances = ordinary_parameters(question.model_file);
    question.train = {record(1)};
    question.test = {record(2)};
    return question;
  }
};

}  // namespace discovery
}  // namespace anthrob
