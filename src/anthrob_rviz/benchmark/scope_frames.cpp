// How often the scope draws 60 live quantities of 500 Hz over 60 s. To be run on one core, without
// a screen:
//   QT_QPA_PLATFORM=offscreen taskset -c 0 scope_frames [QUANTITIES [SECONDS]]
#include <QApplication>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>

#include "anthrob_core/monotonic_clock.h"
#include "plot/scope_widget.h"

namespace anthrob {
namespace {

constexpr Nanoseconds kPeriod = 2000000;  // 500 Hz

/// Noisy sines, as many as asked for, that have come for a minute, and go on.
class SineTopics final : public LiveTopics {
 public:
  explicit SineTopics(int quantities) {
    auto contents = std::make_shared<MessageContents>();
    for (int i = 0; i < quantities; ++i) {
      const std::string name = "q" + std::to_string(i);
      contents->quantities.push_back(
          {"/robot/state/force/" + name, "/robot/state", "/robot/state/force", name, "N"});
    }
    contents_ = contents;
  }
  MasterView master() const override { return {"none", true, {"/robot/state"}}; }
  void hear(const std::set<std::string>&) override {}
  std::vector<LiveMessage> take() override {
    std::vector<LiveMessage> messages;
    const auto due =
        static_cast<Nanoseconds>(1e9 * (monotonic_now() - begin_)) + ScopeModel::kWindow;
    for (; sent_ <= due; sent_ += kPeriod)
      messages.push_back({"/robot/state", sent_, {sent_, values(), contents_}});
    return messages;
  }
  std::vector<std::string> take_remarks() override { return {}; }
  const MessageContents& contents() const { return *contents_; }

 private:
  std::vector<double> values() {
    std::vector<double> values(contents_->quantities.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto phase = static_cast<double>(i);
      values[i] =
          phase + std::sin(seconds(sent_) + phase) + 0.3 * (std::rand() / (0.5 * RAND_MAX) - 1.0);
    }
    return values;
  }

  std::shared_ptr<const MessageContents> contents_;
  double begin_ = monotonic_now();
  Nanoseconds sent_ = 0;
};

void measure(int quantities, double duration) {
  auto topics = std::make_unique<SineTopics>(quantities);
  std::set<std::string> paths;
  for (const Quantity& quantity : topics->contents().quantities) paths.insert(quantity.path);
  ScopeWidget scope(std::make_unique<ScopeModel>(std::move(topics), nullptr));
  scope.resize(1280, 800);
  scope.show();
  scope.tick(paths);
  scope.refresh();
  scope.plots().set_range({0.0, 60.0});
  QApplication::processEvents();
  const double begin = monotonic_now();
  const std::clock_t used = std::clock();
  int frames = 0;
  for (; monotonic_now() - begin < duration; ++frames) {
    scope.refresh();
    QApplication::processEvents();
  }
  const double wall = monotonic_now() - begin,
               cpu = static_cast<double>(std::clock() - used) / CLOCKS_PER_SEC;
  std::size_t samples = 0;
  for (const Curve& curve : scope.model().curves()) samples += curve.samples.size();
  std::printf(
      "%d quantities, %zu samples: %.1f frames/s, %.1f frames per second of processor time\n",
      quantities, samples, frames / wall, frames / cpu);
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  anthrob::measure(argc > 1 ? std::atoi(argv[1]) : 60, argc > 2 ? std::atof(argv[2]) : 10.0);
}
