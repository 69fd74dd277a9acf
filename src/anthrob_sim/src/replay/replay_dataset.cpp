// The replay of a whole recording, as a recording.
#include <algorithm>
#include <cmath>
#include <set>

#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/replay/replay.h"
#include "replay/replay_modes.h"
#include "replay/table_sampler.h"

namespace anthrob {

namespace {

/// Tables of the output: those of the recording, and what they lack in the standard ones.
std::vector<Table> output_tables(const RobotModel& model, const Dataset& recording) {
  std::vector<Table> tables;
  std::set<std::string> have;
  const Table* densest = nullptr;
  for (const Table& table : recording.tables) {
    if (table.name == "wrenches") continue;  // no reading: see copy_pushes()
    Table copy;
    copy.name = table.name;
    copy.t = table.t;
    for (const Column& column : table.columns) {
      copy.columns.push_back({column.name, {}, {}});
      have.insert(column.name);
    }
    tables.push_back(copy);
    if (!densest || table.t.size() > densest->t.size()) densest = &table;
  }
  const auto add = [&](const std::string& table_name, const std::string& column) {
    if (have.count(column)) return;
    auto table = std::find_if(tables.begin(), tables.end(),
                              [&](const Table& t) { return t.name == table_name; });
    if (table == tables.end()) {
      Table fresh;
      fresh.name = table_name;
      fresh.t = densest->t;
      tables.push_back(fresh);
      table = tables.end() - 1;
    }
    table->columns.push_back({column, {}, {}});
  };
  for (const MuscleModel& muscle : model.muscles) {
    for (const char* quantity :
         {"mode", "reference", "position", "velocity", "current", "voltage", "force"}) {
      add("muscles", muscle.name + "/" + quantity);
    }
  }
  for (const JointModel& joint : model.skeleton->joints) {
    if (joint.type == JointType::kBall) {
      for (const char* quantity : {"w", "x", "y", "z", "wx", "wy", "wz"}) {
        add("spherical_joints", joint.name + "/" + quantity);
      }
    } else {
      add("joints", joint.name + "/position");
      add("joints", joint.name + "/velocity");
    }
  }
  return tables;
}

/// Puts recorded commands in place of simulated ones, row by row. In columns of a motor unit that
/// reports its state, rows without a recorded mode or reference keep the simulated value.
void restore_commands(const Dataset& recording, Dataset& out) {
  for (Table& table : out.tables) {
    const Table* source = recording.find_table(table.name);
    for (Column& column : table.columns) {
      if (!source || (column.quantity() != "mode" && column.quantity() != "reference")) continue;
      const Column* original = source->find(column.name);
      if (!original) continue;
      const bool of_unit = source->find(column.owner() + "/ecu_state") != nullptr;
      for (std::size_t i = 0; i < column.values.size(); ++i) {
        if (of_unit && !original->present[i]) continue;
        column.values[i] = original->values[i];
        column.present[i] = original->present[i];
      }
    }
  }
}

/// What pushed is the same, up to where the replay came.
void copy_pushes(const Dataset& recording, double duration, Dataset& out) {
  const Table* pushes = recording.find_table("wrenches");
  if (!pushes) return;
  Table copy = *pushes;
  std::size_t rows = 0;
  while (rows < copy.t.size() && seconds(copy.t[rows] - recording.begin()) <= duration) ++rows;
  for (auto* times : {&copy.t, &copy.stamp, &copy.bag_time}) {
    if (!times->empty()) times->resize(rows);
  }
  for (Column& column : copy.columns) {
    column.values.resize(rows);
    column.present.resize(rows);
  }
  out.tables.push_back(std::move(copy));
}

/// Where positions are imposed, no motor runs: it has neither voltage nor current.
void leave_out_imposed(const Dataset& recording, Dataset& out) {
  for (Table& table : out.tables) {
    for (Column& column : table.columns) {
      const bool electric = column.quantity() == "voltage" || column.quantity() == "current";
      if (!electric || recording.series(column.owner() + "/position").empty()) continue;
      std::fill(column.present.begin(), column.present.end(), 0);
    }
  }
}

}  // namespace

Dataset replay(const std::shared_ptr<const RobotModel>& model, const Dataset& recording,
               ReplayMode mode, const std::function<bool(double)>& progress, std::string* failure) {
  refuse_implausible_values(*model, recording);
  const Replay input(model, recording, mode);
  std::vector<TableSampler> samplers;
  for (Table& table : output_tables(*model, recording)) {
    samplers.emplace_back(*model, std::move(table), recording.begin());
  }

  const auto steps = static_cast<std::int64_t>(std::ceil(input.duration() / model->step - 1e-6));
  std::int64_t done = 0;
  bool started = false;
  try {
    Simulation sim(model);
    started = input.start(sim, [&] { return !progress || progress(0.0); });
    Replay::Run run(input, sim);
    for (auto& sampler : samplers) {
      if (started) sampler.sample(sim, 0.0);
    }
    for (bool wanted = started; wanted && done < steps; ++done) {
      const double time = static_cast<double>(done) * model->step;
      run.drive(time);
      sim.step();
      for (auto& sampler : samplers) sampler.sample(sim, time + model->step);
      wanted = !progress || done % 1000 != 0 ||
               progress(static_cast<double>(done) / static_cast<double>(steps));
    }
  } catch (const NumericalFailure& error) {
    if (!failure) throw;
    *failure = error.what();
  }

  Dataset out;
  out.meta = recording.meta;
  out.meta.other["simulated_by"] = "anthrob_replay\n";
  out.meta.other.erase("cut_short");  // describes the input recording, not this one
  if (done < steps || !started || (failure && !failure->empty())) {
    out.meta.other["cut_short"] = "at " + exact_text(static_cast<double>(done) * model->step) +
                                  " s of " + exact_text(input.duration()) + " s\n";
  }
  for (auto& sampler : samplers) out.tables.push_back(sampler.take());
  restore_commands(recording, out);
  copy_pushes(recording, static_cast<double>(done) * model->step + 1e-9, out);
  if (imposes_positions(mode)) leave_out_imposed(recording, out);
  return out;
}

}  // namespace anthrob
