#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A queue of whole periods and what is between two of them blended.
class LateCommands final : public CommandLaw {
 public:
  LateCommands(std::vector<std::size_t> muscles, double delay)
      : muscles_(std::move(muscles)), delay_(delay / kPeriod) {}
  void apply(double, std::vector<double>* references) override {
    const auto whole = static_cast<std::size_t>(delay_);
    const double part = delay_ - static_cast<double>(whole);
    queue_.insert(queue_.begin(), *references);
    if (queue_.size() > whole + 2) queue_.pop_back();
    const auto& newer = queue_[std::min(whole, queue_.size() - 1)];
    const auto& older = queue_[std::min(whole + 1, queue_.size() - 1)];
    for (const std::size_t i : muscles_) {
      (*references)[i] = part == 0.0 ? newer[i] : newer[i] + part * (older[i] - newer[i]);
    }
  }

 private:
  static constexpr double kPeriod = 1e-3;  // [s]
  std::vector<std::size_t> muscles_;
  double delay_;  // periods
  std::vector<std::vector<double>> queue_;
};

}  // namespace

HiddenLaw command_latency() {
  HiddenLaw law;
  law.id = "command_latency";
  law.law = "as in the catalogue";
  law.sizes = {"delay"};
  law.places = muscle_places_and_all;
  law.most = 10.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"delay", 0.01}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->command_laws.push_back(
        std::make_shared<LateCommands>(draft->muscles(h.place), h["delay"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
