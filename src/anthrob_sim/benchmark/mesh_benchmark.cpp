// Cost of a mesh muscle: its surface alone over a motion of 10 s, against a cylinder, against CGAL
// without memory, and against the number of vertices; how often the remembered strip did not do.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "anthrob_sim/simulation.h"
#include "path/cylinder.h"
#include "path/mesh_reference.h"
#include "path/mesh_surface.h"

namespace anthrob {
namespace {

constexpr int kSteps = 10000;  // 10 s at 1 ms

/// What the two points next to a surface do over the motion, in the surface's frame.
struct Motion {
  std::string name;
  std::shared_ptr<const WrappingSurface> surface;
  std::vector<Vec3> before, after;
};

/// All muscles at work, as in the benchmark of the whole arm.
void drive(Simulation& sim, int step) {
  if (step % 50 != 0) return;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const double phase = 0.7 * static_cast<double>(m) + 1.3e-3 * step;
    sim.command(static_cast<int>(m), ecu::Mode::kPosition, 0.8 + 0.7 * std::sin(phase));
  }
}

std::vector<Motion> motions_of_arm(const std::string& model, const std::string& type) {
  Simulation sim(
      load_robot_model(std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_" + model + ".yaml"));
  std::vector<Motion> motions;
  std::vector<std::pair<std::size_t, std::size_t>> where;
  for (std::size_t m = 0; m < sim.muscle_count(); ++m) {
    const auto& list = sim.model().muscles[m].path->obstacles();
    for (std::size_t i = 0; i < list.size(); ++i) {
      if (!list[i].surface || list[i].surface->type() != type) continue;
      motions.push_back({sim.model().muscles[m].name, list[i].surface, {}, {}});
      where.emplace_back(m, i);
    }
  }
  for (int step = 0; step < 2000 + kSteps; ++step) {
    drive(sim, step);
    sim.step();
    if (step < 2000) continue;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      const auto& list = sim.model().muscles[where[k].first].path->obstacles();
      const std::size_t i = where[k].second;
      const auto local = [&](const PathObstacle& point) {
        return sim.bodies()[list[i].body].X_WB.to_local(sim.bodies()[point.body].X_WB *
                                                        point.point_B);
      };
      motions[k].before.push_back(local(list[i - 1]));
      motions[k].after.push_back(local(list[i + 1]));
    }
  }
  return motions;
}

/// A bone-shaped body of `count` vertices, a point on it and one that swings round it.
/// @param fixed the surface knows that the point on it stays where it is, as in a model
Motion motion_round_body(int count, bool fixed) {
  const Vec3 radii(0.020, 0.050, 0.018);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / count, turn = 2.399963229728653 * i;
    const double r = std::sqrt(1.0 - y * y);
    points.push_back(radii.cwiseProduct(Vec3(r * std::cos(turn), y, r * std::sin(turn))));
  }
  const Vec3 insertion = 1.002 * radii.cwiseProduct(Vec3(0.6, 0.1, -0.79).normalized());
  std::shared_ptr<const WrappingSurface> surface =
      std::make_shared<MeshSurface>(points, Vec3::UnitX());
  // The largest do without distances from their fixed end.
  if (fixed) {
    if (const auto prepared = surface->prepared_for(nullptr, &insertion)) surface = prepared;
  }
  Motion motion{std::to_string(count), surface, {}, {}};
  for (int i = 0; i < kSteps; ++i) {
    const double t = 1e-3 * i;
    motion.before.emplace_back(0.012 + 0.01 * std::sin(1.3 * t), 0.01 + 0.02 * std::sin(0.9 * t),
                               0.05 + 0.01 * std::cos(1.7 * t));
    motion.after.push_back(insertion);
  }
  return motion;
}

/// Every iteration is one step of the motion; the slowest of each step's repetitions do not count,
/// since other programs interrupt: the worst step is the one whose best repetition is longest.
void run(benchmark::State& state, const std::vector<Motion>& motions) {
  std::vector<std::vector<double>> memories;
  for (const Motion& motion : motions) memories.emplace_back(motion.surface->state_size(), 0.0);
  WrapContact contact;
  const auto start = [&](std::size_t k) {
    motions[k].surface->initialise(motions[k].before[0], motions[k].after[0],
                                   StateView(memories[k].data()));
  };
  std::vector<std::vector<double>> best(motions.size(), std::vector<double>(kSteps, 1e9));
  int step = kSteps;
  std::size_t k = motions.size() - 1;
  double touching = 0.0, total = 0.0;
  for (auto _ : state) {
    if (step >= kSteps) {
      step = 0;
      k = (k + 1) % motions.size();
      start(k);
      motions[k].surface->wrap(motions[k].before[0], motions[k].after[0],
                               StateView(memories[k].data()), contact);
    }
    const auto begin = std::chrono::steady_clock::now();
    motions[k].surface->wrap(motions[k].before[step], motions[k].after[step],
                             StateView(memories[k].data()), contact);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    state.SetIterationTime(taken.count());
    best[k][step] = std::min(best[k][step], 1e6 * taken.count());
    touching += contact.touching;
    total += 1.0;
    ++step;
  }
  std::vector<double> all;
  for (const auto& steps : best) {
    std::copy_if(steps.begin(), steps.end(), std::back_inserter(all),
                 [](double t) { return t < 1e8; });
  }
  std::sort(all.begin(), all.end());
  state.counters["median_us"] = all[all.size() / 2];
  state.counters["p99_us"] = all[all.size() * 99 / 100];
  state.counters["worst_us"] = all.back();
  state.counters["touching"] = touching / total;
  double solved = 0.0, cold = 0.0, improved = 0.0;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (motions[i].surface->type() != "mesh") continue;
    const auto counts = MeshSurface::counts(StateView(memories[i].data()));
    solved += counts.solved;
    cold += std::max(0.0, counts.cold - 1.0);  // the first has nothing to start from
    improved += counts.improved;
  }
  if (solved > 0.0) {
    state.counters["improved"] = improved / solved;
    state.counters["cold"] = cold / solved;
  }
}

void add(const std::string& name, std::vector<Motion> motions, int rounds) {
  const auto steps = static_cast<benchmark::IterationCount>(kSteps * rounds * motions.size());
  benchmark::RegisterBenchmark(
      name.c_str(), [motions = std::move(motions)](benchmark::State& s) { run(s, motions); })
      ->Unit(benchmark::kMicrosecond)
      ->UseManualTime()
      ->Iterations(steps);
}

/// The same ways by convex_hull_3 and Surface_mesh_shortest_path, from nothing each time.
void run_cgal(benchmark::State& state, const Motion& motion) {
  const auto& surface = static_cast<const MeshSurface&>(*motion.surface);
  std::size_t step = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(testing_support::reference_way(
        surface.hull().vertices(), motion.before[step], motion.after[step], surface.chi()));
    step = (step + 101) % motion.before.size();
  }
}

void register_all() {
  const auto meshes = motions_of_arm("III", "mesh");
  for (const Motion& motion : meshes) add("mesh/" + motion.name, {motion}, 3);
  add("mesh/all", meshes, 3);
  add("cylinder/all", motions_of_arm("II", "cylinder"), 3);
  benchmark::RegisterBenchmark("cgal_cold/anterior_deltoid", [motion = meshes[1]](auto& s) {
    run_cgal(s, motion);
  })->Unit(benchmark::kMicrosecond);
  for (const int count : {100, 300, 1000, 3000, 10000, 30000}) {
    add("vertices/" + std::to_string(count), {motion_round_body(count, true)}, 2);
  }
  for (const int count : {100, 1000, 10000}) {
    add("both_ends_move/" + std::to_string(count), {motion_round_body(count, false)}, 2);
  }
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  anthrob::register_all();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
