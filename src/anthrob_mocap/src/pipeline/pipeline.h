#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace anthrob {
namespace mocap {

/// What runs through a pipeline; stages read and write their parts of it.
struct Packet {
  virtual ~Packet() = default;
  std::vector<double> stage_seconds;  ///< by stage: what it took
};
using PacketPtr = std::unique_ptr<Packet>;

/// One step of the work. Lanes work on disjoint parts of a packet and may run at the same time.
struct Stage {
  std::string name;
  std::vector<std::function<void(Packet&)>> lanes;
};

enum class PipelineMode { kSequential, kThreaded };
/// @throws BadInput unless "sequential" or "threaded"
PipelineMode pipeline_mode(const std::string& word);

/// A chain of stages. Every stage sees the packets in the order in which they were pushed, one at a
/// time, in either mode; so stages may keep state, and results do not depend on the mode.
/// Threaded, different stages work on different packets at the same time (a oneTBB flow graph).
class Pipeline {
 public:
  /// Takes a packet that is done; called in order, one at a time.
  using Sink = std::function<void(PacketPtr)>;

  /// @param in_flight packets that may be in the pipeline at once (threaded)
  Pipeline(std::vector<Stage> stages, PipelineMode mode, int in_flight, Sink sink);
  ~Pipeline();  ///< finishes what is in flight

  /// Sequential: returns when the packet is done. Threaded: returns at once, unless `in_flight`
  /// packets are on their way; then it waits for the first of them.
  /// @throws what a stage or the sink has thrown; threaded, from the next push on, until drain
  void push(PacketPtr packet);
  /// Waits until nothing is in flight.
  /// @throws what a stage has thrown
  void drain();

  const std::vector<Stage>& stages() const;

  class Runner;

 private:
  std::unique_ptr<Runner> runner_;
};

}  // namespace mocap
}  // namespace anthrob
