#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/random.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_sim/simulation.h"

namespace anthrob {

/// Recordings by the simulator itself, of a model that is known: what recovery is tested with.
struct RecordingPlan {
  std::vector<double> from, to;  ///< references by muscle [rad]
  std::string kind = "equilibrium";
  double settle = 2.0;       ///< at `from`, before the recording [s]
  double lead = 0.5;         ///< recorded before the command [s]
  double duration = 2.0;     ///< recorded after it [s]
  double angle_noise = 0.0;  ///< [rad]
  double force_noise = 0.0;  ///< [N]
  std::uint64_t seed = 1;
};

inline Dataset record_simulation(const std::shared_ptr<const RobotModel>& model,
                                 const RecordingPlan& plan) {
  Simulation sim(model);
  const auto muscles = static_cast<int>(model->muscles.size());
  const auto command = [&](const std::vector<double>& references) {
    for (int m = 0; m < muscles; ++m) sim.command(m, ecu::Mode::kPosition, references[m]);
  };
  sim.place(model->skeleton->rest_configuration(), std::vector<double>(muscles, 0.0));
  command(plan.from);
  sim.step(static_cast<int>(std::lround(plan.settle / sim.step_length())));

  const CounterRandom noise(plan.seed);
  std::uint64_t drawn = 0;
  Dataset data;
  data.folder = "simulated";
  data.meta.robot = model->name;
  data.meta.kind = plan.kind;
  data.meta.settle_s = plan.settle;
  Table table;
  table.name = "muscles";
  const auto put = [&](const std::string& name, double value) {
    Column& column = table.column(name);
    column.values.back() = value;
    column.present.back() = 1;
  };
  const auto sample = [&](int step) {
    table.t.push_back(static_cast<Nanoseconds>(std::llround(step * sim.step_length() * 1e9)));
    for (Column& column : table.columns) column.values.push_back(0.0), column.present.push_back(0);
    for (int m = 0; m < muscles; ++m) {
      const std::string& name = model->muscles[m].name;
      put(name + "/reference", sim.muscle(m).reference());
      const ecu::Measurement& measured = sim.muscle(m).measured();
      put(name + "/position", measured.position);
      put(name + "/force", measured.force + plan.force_noise * noise.normal(drawn++));
    }
    for (std::size_t j = 0; j < model->skeleton->joints.size(); ++j) {
      const JointModel& joint = model->skeleton->joints[j];
      const double* q = sim.read_positions() + joint.position_offset;
      if (joint.type != JointType::kBall) {
        put(joint.name + "/position", sim.measured_joint_position(static_cast<int>(j)) +
                                          plan.angle_noise * noise.normal(drawn++));
        continue;
      }
      Quat turn(q[0], q[1], q[2], q[3]);
      const Vec3 error(noise.normal(drawn), noise.normal(drawn + 1), noise.normal(drawn + 2));
      drawn += 3;
      const Vec3 half = 0.5 * plan.angle_noise * error;
      turn = (turn * Quat(1.0, half.x(), half.y(), half.z())).normalized();
      const double values[] = {turn.w(), turn.x(), turn.y(), turn.z()};
      for (int k = 0; k < 4; ++k) put(joint.name + "/" + std::string(1, "wxyz"[k]), values[k]);
    }
  };
  const int every = 5, lead = static_cast<int>(std::lround(plan.lead / sim.step_length()));
  const int end = lead + static_cast<int>(std::lround(plan.duration / sim.step_length()));
  for (int step = 0; step <= end; ++step) {
    if (step == lead) command(plan.to);
    if (step % every == 0) sample(step);
    sim.step();
  }
  data.tables.push_back(table);
  return data;
}

}  // namespace anthrob
