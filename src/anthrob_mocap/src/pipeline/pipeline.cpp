#include "pipeline/pipeline.h"

#include <tbb/flow_graph.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <condition_variable>
#include <mutex>

#include "anthrob_core/errors.h"
#include "anthrob_core/monotonic_clock.h"

namespace anthrob {
namespace mocap {

PipelineMode pipeline_mode(const std::string& word) {
  if (word == "sequential") return PipelineMode::kSequential;
  if (word == "threaded") return PipelineMode::kThreaded;
  throw BadInput("pipeline: " + word + ": expected sequential or threaded");
}

namespace {

void run_lanes(const Stage& stage, Packet& packet, bool parallel) {
  if (!parallel || stage.lanes.size() == 1) {
    for (const auto& lane : stage.lanes) lane(packet);
  } else {
    tbb::parallel_for(std::size_t{0}, stage.lanes.size(),
                      [&](std::size_t i) { stage.lanes[i](packet); });
  }
}

void run_stage(const Stage& stage, std::size_t index, Packet& packet, bool parallel) {
  const double start = monotonic_now();
  run_lanes(stage, packet, parallel);
  packet.stage_seconds[index] = monotonic_now() - start;
}

}  // namespace

class Pipeline::Runner {
 public:
  Runner(std::vector<Stage> stages, Sink sink)
      : stages_(std::move(stages)), sink_(std::move(sink)) {}
  virtual ~Runner() = default;
  virtual void push(PacketPtr packet) = 0;
  virtual void drain() = 0;

  const std::vector<Stage> stages_;

 protected:
  const Sink sink_;
};

namespace {

class SequentialRunner final : public Pipeline::Runner {
 public:
  using Runner::Runner;

  void push(PacketPtr packet) override {
    for (std::size_t i = 0; i < stages_.size(); ++i) run_stage(stages_[i], i, *packet, false);
    sink_(std::move(packet));
  }
  void drain() override {}
};

/// A chain of serial nodes: each takes messages in the order of their arrival, so order is kept.
class ThreadedRunner final : public Pipeline::Runner {
 public:
  ThreadedRunner(std::vector<Stage> stages, Pipeline::Sink sink, int in_flight)
      : Runner(std::move(stages), std::move(sink)), free_(in_flight) {
    for (std::size_t i = 0; i < stages_.size(); ++i) {
      nodes_.push_back(std::make_unique<Node>(graph_, tbb::flow::serial, [this, i](Packet* packet) {
        // An exception must not leave this function: the packet would never be counted as done.
        try {
          if (!failed()) run_stage(stages_[i], i, *packet, true);
        } catch (...) {
          fail(std::current_exception());
        }
        return packet;
      }));
      if (i > 0) tbb::flow::make_edge(*nodes_[i - 1], *nodes_[i]);
    }
    last_ = std::make_unique<Node>(graph_, tbb::flow::serial, [this](Packet* packet) {
      finish(PacketPtr(packet));
      return nullptr;
    });
    tbb::flow::make_edge(*nodes_.back(), *last_);
  }

  ~ThreadedRunner() override { graph_.wait_for_all(); }

  void push(PacketPtr packet) override {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return free_ > 0; });
      // failure_ is kept until drain(): packets in flight must not continue after a failed stage.
      if (failure_) std::rethrow_exception(failure_);
      --free_;
    }
    nodes_.front()->try_put(packet.release());
  }

  void drain() override {
    graph_.wait_for_all();
    std::exception_ptr failure;
    std::swap(failure, failure_);
    if (failure) std::rethrow_exception(failure);
  }

 private:
  using Node = tbb::flow::function_node<Packet*, Packet*>;

  bool failed() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return failure_ != nullptr;
  }
  void fail(std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!failure_) failure_ = failure;
  }
  void finish(PacketPtr packet) {
    try {
      if (!failed()) sink_(std::move(packet));
    } catch (...) {
      fail(std::current_exception());
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    ++free_;
    changed_.notify_one();
  }

  tbb::flow::graph graph_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::unique_ptr<Node> last_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int free_;
  std::exception_ptr failure_;
};

}  // namespace

Pipeline::Pipeline(std::vector<Stage> stages, PipelineMode mode, int in_flight, Sink sink) {
  if (stages.empty()) throw std::invalid_argument("pipeline: expected at least one stage");
  if (in_flight < 1) throw std::invalid_argument("pipeline: expected room for at least one packet");
  // push() waits for worker threads, and with a single processor there are none.
  const bool workers = tbb::this_task_arena::max_concurrency() > 1;
  if (mode == PipelineMode::kSequential || !workers) {
    runner_ = std::make_unique<SequentialRunner>(std::move(stages), std::move(sink));
  } else {
    runner_ = std::make_unique<ThreadedRunner>(std::move(stages), std::move(sink), in_flight);
  }
}

Pipeline::~Pipeline() = default;

void Pipeline::push(PacketPtr packet) {
  packet->stage_seconds.assign(runner_->stages_.size(), 0.0);
  runner_->push(std::move(packet));
}

void Pipeline::drain() {
  runner_->drain();
}

const std::vector<Stage>& Pipeline::stages() const {
  return runner_->stages_;
}

}  // namespace mocap
}  // namespace anthrob
