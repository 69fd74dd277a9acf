// How the cost of a step grows with the robot, and how many simulations a machine runs at once.
// Robots are those that scripts/make_torso.py wrote to $ANTHROB_BENCH_ROBOTS.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <thread>

#include "anthrob_sim/simulation.h"

namespace anthrob {
namespace {

/// All muscles at work: slow co-contraction, each with its own phase.
void drive(Simulation& sim, std::int64_t step) {
  if (step % 50 != 0) return;
  const double t = 1e-3 * static_cast<double>(step);
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    sim.command(static_cast<int>(m), ecu::Mode::kPosition,
                0.3 + 0.3 * std::sin(1.3 * t + 0.7 * static_cast<double>(m)));
  }
}

void run_steps(benchmark::State& state, const std::shared_ptr<const RobotModel>& model) {
  Simulation sim(model);
  std::int64_t step = 0;
  for (; step < 1000; ++step) drive(sim, step), sim.step();
  std::int64_t sweeps = 0;
  for (auto _ : state) {
    drive(sim, step++);
    sim.step();
    sweeps += sim.last_step().solver_iterations;
  }
  state.counters["sweeps"] =
      benchmark::Counter(static_cast<double>(sweeps), benchmark::Counter::kAvgIterations);
  state.counters["steps_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void add(const std::string& name, const std::string& file) {
  const auto model = load_robot_model(file);
  benchmark::RegisterBenchmark(name.c_str(), [model](benchmark::State& s) {
    run_steps(s, model);
  })->Unit(benchmark::kMicrosecond);
}

void register_all(const std::filesystem::path& robots) {
  for (const int muscles : {0, 10, 20, 50, 100, 200}) {
    const std::string name = "muscles_" + std::to_string(muscles);
    add("muscles/" + std::to_string(muscles), robots / name / "model_II.yaml");
  }
  for (const int joints : {1, 5, 10, 20, 40}) {
    const std::string name = "joints_" + std::to_string(joints);
    add("joints/" + std::to_string(joints), robots / name / "model_II.yaml");
  }
  // Simulations share nothing: threads across them cost no locks.
  const auto arm = load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_II.yaml");
  const int cores = std::max(1u, std::thread::hardware_concurrency());
  for (int threads = 1; threads <= cores; threads *= 2) {
    benchmark::RegisterBenchmark("parallel_arms", [arm](benchmark::State& s) { run_steps(s, arm); })
        ->Threads(threads)
        ->UseRealTime()
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  const char* robots = std::getenv("ANTHROB_BENCH_ROBOTS");
  if (!robots) {
    std::cerr << "scaling_benchmark: set ANTHROB_BENCH_ROBOTS to the folder with the robots; "
                 "./catkin_ws.sh bench does it\n";
    return 2;
  }
  anthrob::register_all(robots);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
