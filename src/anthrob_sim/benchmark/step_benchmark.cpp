// Cost of one step of 1 ms: the skeleton, what one muscle adds, the whole arm, beside MuJoCo in the
// same run.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "anthrob_sim/simulation.h"
#ifdef ANTHROB_HAVE_MUJOCO
#include "mujoco_peer.h"
#endif

namespace anthrob {
namespace {

std::string config(const std::string& file) {
  return std::string(ANTHROB_CONFIG_DIR) + "/" + file;
}

/// Anthrob with only some of its muscles: none, or those named.
std::shared_ptr<const RobotModel> arm_with(const std::string& model,
                                           const std::vector<std::string>& muscles) {
  auto robot =
      std::make_shared<RobotModel>(*load_robot_model(config("anthrob/model_" + model + ".yaml")));
  std::vector<MuscleModel> kept;
  for (const MuscleModel& muscle : robot->muscles) {
    for (const std::string& name : muscles) {
      if (muscle.name == name) kept.push_back(muscle);
    }
  }
  robot->muscles = kept;
  return robot;
}

std::shared_ptr<const RobotModel> whole_arm(const std::string& model) {
  return load_robot_model(config("anthrob/model_" + model + ".yaml"));
}

/// All muscles at work: references of a slow motion through the work space.
void drive(Simulation& sim, std::int64_t step) {
  if (step % 50 != 0) return;
  const double t = 1e-3 * static_cast<double>(step);
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const double phase = 0.7 * static_cast<double>(m);
    sim.command(static_cast<int>(m), ecu::Mode::kPosition, 0.8 + 0.7 * std::sin(1.3 * t + phase));
  }
}

void run_ours(benchmark::State& state, const std::shared_ptr<const RobotModel>& model) {
  Simulation sim(model);
  std::int64_t step = 0;
  for (; step < 2000; ++step) drive(sim, step), sim.step();
  std::int64_t sweeps = 0;
  for (auto _ : state) {
    drive(sim, step++);
    sim.step();
    sweeps += sim.last_step().solver_iterations;
  }
  state.counters["friction_sweeps"] =
      benchmark::Counter(static_cast<double>(sweeps), benchmark::Counter::kAvgIterations);
}

#ifdef ANTHROB_HAVE_MUJOCO
void run_mujoco(benchmark::State& state, const std::shared_ptr<const RobotModel>& model) {
  MujocoPeer peer(*model);
  std::int64_t step = 0;
  const auto drive_peer = [&] {
    if (step++ % 50 != 0) return;
    const double t = 1e-3 * static_cast<double>(step);
    for (int m = 0; m < peer.model().nu; ++m) {
      peer.data().ctrl[m] = 8.0 + 7.0 * std::sin(1.3 * t + 0.7 * m);
    }
  };
  for (int i = 0; i < 2000; ++i) drive_peer(), peer.step();
  for (auto _ : state) {
    drive_peer();
    peer.step();
  }
}
#endif

void add(const std::string& name, const std::shared_ptr<const RobotModel>& model) {
  benchmark::RegisterBenchmark(name.c_str(), [model](benchmark::State& s) {
    run_ours(s, model);
  })->Unit(benchmark::kMicrosecond);
}

void add_peer(const std::string& name, const std::shared_ptr<const RobotModel>& model) {
#ifdef ANTHROB_HAVE_MUJOCO
  benchmark::RegisterBenchmark(name.c_str(), [model](benchmark::State& s) {
    run_mujoco(s, model);
  })->Unit(benchmark::kMicrosecond);
#else
  (void)name, (void)model;
#endif
}

void register_all() {
  add("skeleton", arm_with("I", {}));
  add_peer("mujoco_skeleton", arm_with("I", {}));
  add("one_muscle/straight", arm_with("I", {"anterior_deltoid"}));
  add_peer("mujoco_one_muscle/straight", arm_with("I", {"anterior_deltoid"}));
  add("one_muscle/cylinder", arm_with("II", {"anterior_deltoid"}));
  add_peer("mujoco_one_muscle/cylinder", arm_with("II", {"anterior_deltoid"}));
  for (const char* model : {"I", "II"}) {
    add(std::string("whole_arm/") + model, whole_arm(model));
    add_peer(std::string("mujoco_arm/") + model, whole_arm(model));
  }
  add("one_muscle/mesh", arm_with("III", {"anterior_deltoid"}));
  add("whole_arm/III", whole_arm("III"));  // MuJoCo has no meshes to wrap on
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  anthrob::register_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
