// Appendix F, Figure F.2: packets run through a chain of stages, each of which finds the prime
// factors of the integers from 4 to 25000. Latency, throughput, time; the table adds the speed-up.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "pipeline/pipeline.h"

namespace anthrob {
namespace mocap {
namespace {

constexpr int kPackets = 20;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Integers final : Packet {
  double pushed = 0.0;
  long factors = 0;
};

void factorise(Packet& packet) {
  long factors = 0;
  for (int n = 4; n <= 25000; ++n) {
    int rest = n;
    for (int d = 2; d * d <= rest; ++d) {
      for (; rest % d == 0; rest /= d) ++factors;
    }
    ++factors;
  }
  static_cast<Integers&>(packet).factors += factors;
}

/// @param state range 0: stages; as many packets as stages are on their way at once
void chain(benchmark::State& state, PipelineMode mode) {
  const auto count = static_cast<std::size_t>(state.range(0));
  std::vector<double> latency;
  Pipeline pipeline(
      std::vector<Stage>(count, {"factors", {factorise}}), mode, static_cast<int>(count),
      [&](PacketPtr packet) { latency.push_back(now() - static_cast<Integers&>(*packet).pushed); });
  for (auto _ : state) {
    for (int i = 0; i < kPackets; ++i) {
      auto packet = std::make_unique<Integers>();
      packet->pushed = now();
      pipeline.push(std::move(packet));
    }
    pipeline.drain();
  }
  std::nth_element(latency.begin(), latency.begin() + latency.size() / 2, latency.end());
  state.counters["latency_ms"] = 1e3 * latency[latency.size() / 2];
  state.counters["packets_per_s"] = benchmark::Counter(
      static_cast<double>(kPackets * state.iterations()), benchmark::Counter::kIsRate);
}

void sequential(benchmark::State& state) {
  chain(state, PipelineMode::kSequential);
}
void threaded(benchmark::State& state) {
  chain(state, PipelineMode::kThreaded);
}

void lengths(benchmark::internal::Benchmark* chain) {
  chain->Arg(1)->Arg(2)->Arg(4)->Arg(8)->Arg(12)->Arg(16)->Arg(20);
  chain->Iterations(1)->UseRealTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(sequential)->Apply(lengths);
BENCHMARK(threaded)->Apply(lengths);

}  // namespace
}  // namespace mocap
}  // namespace anthrob
