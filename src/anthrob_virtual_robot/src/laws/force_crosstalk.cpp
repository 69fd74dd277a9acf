#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

class PickedUp final : public ReadingLaw {
 public:
  PickedUp(std::size_t to, std::size_t from, double share) : to_(to), from_(from), share_(share) {}
  void apply(Readings* readings) override {
    readings->muscles[to_].force += share_ * readings->muscles[from_].force;
  }

 private:
  std::size_t to_, from_;
  double share_;
};

}  // namespace

HiddenLaw force_crosstalk() {
  HiddenLaw law;
  law.id = "force_crosstalk";
  law.law = "as in the catalogue";
  law.sizes = {"share"};
  law.places = muscle_pairs;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"share", 0.05}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    const std::vector<std::string> place = words(h.place);
    draft->reading_laws.push_back(
        std::make_shared<PickedUp>(draft->muscle(place[0]), draft->muscle(place[1]), h["share"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
