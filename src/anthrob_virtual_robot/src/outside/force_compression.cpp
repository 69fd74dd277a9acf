#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Compressed final : public ReadingLaw {
 public:
  Compressed(std::size_t muscle, double share, double knee)
      : muscle_(muscle), share_(share), knee_(knee) {}
  void apply(Readings* readings) override {
    double& f = readings->muscles[muscle_].force;
    f -= share_ * std::max(0.0, f - knee_);
  }

 private:
  std::size_t muscle_;
  double share_, knee_;
};

}  // namespace

HiddenLaw force_compression() {
  HiddenLaw law;
  law.id = "force_compression";
  law.law = "force reading that loses a share beyond a force";
  law.sizes = {"share"};
  law.most = 2.5;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"share", 0.3}, {"knee", random->uniform(8.0, 14.0)}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->reading_laws.push_back(
        std::make_shared<Compressed>(draft->muscle(h.place), h["share"], h["knee"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
