#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// All joints, by a queue of whole periods.
class LateJoints final : public ReadingLaw {
 public:
  explicit LateJoints(double delay) : periods_(static_cast<std::size_t>(delay / kPeriod + 0.5)) {}
  void apply(Readings* readings) override {
    queue_.insert(queue_.begin(), {readings->shoulder, readings->elbow});
    if (queue_.size() > periods_ + 1) queue_.pop_back();
    readings->shoulder = queue_.back().first;
    readings->elbow = queue_.back().second;
  }

 private:
  static constexpr double kPeriod = 1e-3;  // [s]
  std::size_t periods_;
  std::vector<std::pair<Eigen::Quaterniond, double>> queue_;
};

}  // namespace

HiddenLaw mocap_delay() {
  HiddenLaw law;
  law.id = "mocap_delay";
  law.law = "as in the catalogue, whole milliseconds";
  law.sizes = {"delay"};
  law.places = global_place;
  law.most = 10.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"delay", 0.015}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->reading_laws.push_back(std::make_shared<LateJoints>(h["delay"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
