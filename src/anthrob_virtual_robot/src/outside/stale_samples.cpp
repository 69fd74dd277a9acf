#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

/// A bus that repeats old samples now and then.
class Stale final : public ReadingLaw {
 public:
  Stale(std::size_t muscle, double share, double seed, std::uint64_t run)
      : muscle_(muscle), share_(share), random_(static_cast<std::uint64_t>(seed), run) {}
  void apply(Readings* readings) override {
    MuscleReading& now = readings->muscles[muscle_];
    if (left_ == 0 && random_.uniform() < share_ / kLasting) left_ = kLasting;
    if (left_ > 0 && placed_) {
      --left_;
      now = last_;
    }
    last_ = now;
    placed_ = true;
  }

 private:
  static constexpr int kLasting = 40;  // periods
  std::size_t muscle_;
  double share_;
  Random random_;
  MuscleReading last_;
  int left_ = 0;
  bool placed_ = false;
};

}  // namespace

HiddenLaw stale_samples() {
  HiddenLaw law;
  law.id = "stale_samples";
  law.law = "readings that stand still for 40 ms now and then";
  law.sizes = {"share"};
  law.most = 3.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"share", 0.3}, {"seed", std::floor(random->uniform(0.0, 1e6))}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->reading_laws.push_back(
        std::make_shared<Stale>(draft->muscle(h.place), h["share"], h["seed"], draft->run));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
