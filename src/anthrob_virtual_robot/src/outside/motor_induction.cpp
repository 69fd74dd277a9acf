#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Induced final : public ReadingLaw {
 public:
  Induced(std::size_t to, std::size_t from, double gain) : to_(to), from_(from), gain_(gain) {}
  void apply(Readings* readings) override {
    readings->muscles[to_].force += gain_ * readings->muscles[from_].current;
  }

 private:
  std::size_t to_, from_;
  double gain_;  // [N/A]
};

}  // namespace

HiddenLaw motor_induction() {
  HiddenLaw law;
  law.id = "motor_induction";
  law.law = "force reading that picks up another motor's current";
  law.sizes = {"gain"};
  law.most = 10.0;
  law.places = muscle_pairs;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"gain", 3.0}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    const std::vector<std::string> place = words(h.place);
    draft->reading_laws.push_back(
        std::make_shared<Induced>(draft->muscle(place[0]), draft->muscle(place[1]), h["gain"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
