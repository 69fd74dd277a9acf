#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// Counts get lost one by one: each fraction of a turn loses a whole count.
class LostCounts final : public ReadingLaw {
 public:
  LostCounts(std::size_t muscle, double rate, double missed)
      : muscle_(muscle), rate_(rate), missed_(missed) {}
  void start() override {
    travelled_ = 0.0;
    placed_ = false;
  }
  void apply(Readings* readings) override {
    double& position = readings->muscles[muscle_].position;
    if (placed_) travelled_ += std::abs(position - last_);
    last_ = position;
    placed_ = true;
    position += rate_ * readings->t - kCount * std::floor(missed_ * travelled_ / kCount);
  }

 private:
  static constexpr double kCount = 0.0061;  // [rad]
  std::size_t muscle_;
  double rate_, missed_;
  double travelled_ = 0.0, last_ = 0.0;
  bool placed_ = false;
};

}  // namespace

HiddenLaw encoder_drift() {
  HiddenLaw law;
  law.id = "encoder_drift";
  law.law = "either a steady drift, or whole counts that are lost with travel";
  law.sizes = {"rate", "missed"};
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return random->uniform() < 0.5 ? Parameters{{"rate", 3e-3 * random->sign()}, {"missed", 0.0}}
                                   : Parameters{{"rate", 0.0}, {"missed", 0.005}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    for (const std::size_t i : draft->muscles(h.place)) {
      draft->reading_laws.push_back(std::make_shared<LostCounts>(i, h["rate"], h["missed"]));
    }
  };
  return law;
}

}  // namespace anthrob::virtual_robot
