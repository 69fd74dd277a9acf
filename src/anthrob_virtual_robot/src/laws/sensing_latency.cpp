#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A filter of first order, whose mean delay is the latency, instead of a pure delay.
class Filtered final : public ReadingLaw {
 public:
  Filtered(std::size_t muscle, double delay) : muscle_(muscle), delay_(delay) {}
  void apply(Readings* readings) override {
    MuscleReading& now = readings->muscles[muscle_];
    const double gain = placed_ ? kPeriod / (kPeriod + delay_) : 1.0;
    placed_ = true;
    follow(gain, &seen_.position, &now.position);
    follow(gain, &seen_.velocity, &now.velocity);
    follow(gain, &seen_.current, &now.current);
    follow(gain, &seen_.force, &now.force);
  }

 private:
  static constexpr double kPeriod = 1e-3;  // [s]
  static void follow(double gain, double* seen, double* now) {
    if (gain == 1.0) *seen = *now;
    *seen += gain * (*now - *seen);
    *now = *seen;
  }
  std::size_t muscle_;
  double delay_;
  MuscleReading seen_;
  bool placed_ = false;
};

}  // namespace

HiddenLaw sensing_latency() {
  HiddenLaw law;
  law.id = "sensing_latency";
  law.law = "a filter of first order instead of a pure delay";
  law.sizes = {"delay"};
  law.places = muscle_places_and_all;
  law.most = 4.0;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"delay", 0.006}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->reading_laws.push_back(std::make_shared<Filtered>(i, h["delay"]));
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
