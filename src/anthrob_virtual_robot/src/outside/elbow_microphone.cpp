#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A strain gauge that feels the elbow move through its wires: its speed, by difference.
class Microphone final : public ReadingLaw {
 public:
  Microphone(std::size_t muscle, double gain) : muscle_(muscle), gain_(gain) {}
  void apply(Readings* readings) override {
    const double speed = placed_ ? (readings->elbow - last_) / kPeriod : 0.0;
    last_ = readings->elbow;
    placed_ = true;
    readings->muscles[muscle_].force += gain_ * speed;
  }

 private:
  static constexpr double kPeriod = 1e-3;  // [s]
  std::size_t muscle_;
  double gain_;  // [Ns/rad]
  double last_ = 0.0;
  bool placed_ = false;
};

}  // namespace

HiddenLaw elbow_microphone() {
  HiddenLaw law;
  law.id = "elbow_microphone";
  law.law = "force reading that follows the elbow's speed";
  law.sizes = {"gain"};
  law.most = 10.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"gain", 1.5 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->reading_laws.push_back(std::make_shared<Microphone>(draft->muscle(h.place), h["gain"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
