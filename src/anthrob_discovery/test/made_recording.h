#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/random.h"
#include "anthrob_sim/replay/replay.h"
#include "anthrob_sim/statics/equilibrium.h"

namespace anthrob {

/// Recordings for tests: the arm goes from posture to posture under position control, made by the
/// simulator itself. Blind tests take other data; here one wants to know the truth to the last
/// digit.
struct MadeRecording {
  std::uint64_t seed = 1;   ///< of the postures
  double length = 10.0;     ///< [s]
  double rate = 200.0;      ///< [Hz]
  std::uint64_t noise = 1;  ///< seed of the noise
  double position_noise = 1e-3, current_noise = 5e-3, force_noise = 0.05, voltage_noise = 0.02,
         joint_noise = 1e-3;

  Dataset commands(const std::shared_ptr<const RobotModel>& model) const {
    Simulation sim(model);
    const CounterRandom random(seed, 5);
    std::uint64_t index = 0;
    std::vector<std::vector<double>> references;
    constexpr double kLeg = 1.6;
    for (double t = 0.0; t < length + 2.0 * kLeg; t += kLeg) {
      EquilibriumOptions options;
      options.lowest_tension = 3.0 + 12.0 * random.uniform(index++);
      references.push_back(
          find_equilibrium(sim, posture(*model, random, index), options).reference);
    }
    Dataset data;
    data.folder = "made";
    data.meta.robot = model->name;
    data.meta.settle_s = 3.0;
    Table& table = data.table("commands");
    const auto rows = static_cast<std::size_t>(length * 100.0) + 1;
    for (std::size_t m = 0; m < model->muscles.size(); ++m) {
      Column& column = table.column(model->muscles[m].name + "/reference");
      column.values.clear();
      for (std::size_t i = 0; i < rows; ++i) {
        const double at = 0.01 * static_cast<double>(i) / kLeg;
        const auto leg = static_cast<std::size_t>(at);
        const double share = std::min(1.0, 1.6 * (at - static_cast<double>(leg)));
        const double blend = share * share * (3.0 - 2.0 * share);
        column.values.push_back(references[leg][m] +
                                blend * (references[leg + 1][m] - references[leg][m]));
      }
      column.present.assign(rows, 1);
    }
    for (std::size_t i = 0; i < rows; ++i)
      table.t.push_back(static_cast<Nanoseconds>(i) * 10000000);
    return data;
  }

  /// What the robot measured under those commands.
  Dataset measure(const std::shared_ptr<const RobotModel>& robot, Dataset data) const {
    Table& muscles = data.table("muscles");
    const auto rows = static_cast<std::size_t>(length * rate) + 1;
    for (std::size_t i = 0; i < rows; ++i) {
      muscles.t.push_back(
          static_cast<Nanoseconds>(std::llround(1e9 / rate * static_cast<double>(i))));
    }
    for (const MuscleModel& muscle : robot->muscles) {
      for (const char* quantity : {"position", "current", "voltage", "force"}) {
        Column& column = muscles.column(muscle.name + "/" + quantity);
        column.values.assign(rows, 0.0);
        column.present.assign(rows, 0);  // nothing was measured yet
      }
    }
    for (const char* table : {"joints", "spherical_joints"}) {
      Table& joints = data.table(table);
      joints.t = data.find_table("muscles")->t;
      for (const JointModel& joint : robot->skeleton->joints) {
        const bool ball = joint.type == JointType::kBall;
        if (ball != (std::string(table) == "spherical_joints")) continue;
        for (const char* quantity : {"w", "x", "y", "z", "position"}) {
          if (ball == (std::string(quantity) == "position")) continue;
          Column& column = joints.column(joint.name + "/" + quantity);
          column.values.assign(rows, 0.0);
          column.present.assign(rows, 0);  // nothing was measured yet
        }
      }
    }
    Dataset seen = replay(robot, data, ReplayMode::kReference);
    std::uint64_t stream = 0;
    for (Table& table : seen.tables) {
      if (table.name == "commands") continue;
      for (Column& column : table.columns) {
        const double size = noise_of(column.quantity());
        const CounterRandom random(noise, ++stream);
        for (std::size_t i = 0; i < column.values.size(); ++i) {
          column.values[i] += size * random.normal(i);
        }
      }
    }
    return seen;
  }

 private:
  static std::vector<double> posture(const RobotModel& model, const CounterRandom& random,
                                     std::uint64_t& index) {
    std::vector<double> q = model.skeleton->rest_configuration();
    for (const JointModel& joint : model.skeleton->joints) {
      double* at = &q[static_cast<std::size_t>(joint.position_offset)];
      if (joint.type == JointType::kBall) {
        const double abduct = 0.1 + 0.6 * random.uniform(index++),
                     flex = -0.2 + 0.5 * random.uniform(index++);
        const Eigen::Quaterniond turn = Eigen::AngleAxisd(flex, Eigen::Vector3d::UnitX()) *
                                        Eigen::AngleAxisd(-abduct, Eigen::Vector3d::UnitZ());
        at[0] = turn.w(), at[1] = turn.x(), at[2] = turn.y(), at[3] = turn.z();
      } else {
        at[0] = 0.2 + 1.2 * random.uniform(index++);
      }
    }
    return q;
  }

  double noise_of(const std::string& quantity) const {
    if (quantity == "current") return current_noise;
    if (quantity == "force") return force_noise;
    if (quantity == "voltage") return voltage_noise;
    if (quantity == "velocity" || quantity == "mode" || quantity == "reference" ||
        (quantity.size() == 2 && quantity[0] == 'w')) {
      return 0.0;
    }
    if (quantity.size() == 1) return 0.5 * joint_noise;
    return position_noise;
  }
};

}  // namespace anthrob
