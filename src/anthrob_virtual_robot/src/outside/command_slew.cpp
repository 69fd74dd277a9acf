#include "outside/outside.h"

namespace anthrob::virtual_robot {
namespace {

class Slew final : public CommandLaw {
 public:
  Slew(std::size_t muscle, double rate) : muscle_(muscle), rate_(rate) {}
  void apply(double, std::vector<double>* references) override {
    double& reference = (*references)[muscle_];
    if (!placed_) now_ = reference, placed_ = true;
    const double most = rate_ * kPeriod;
    now_ += std::clamp(reference - now_, -most, most);
    reference = now_;
  }

 private:
  static constexpr double kPeriod = 1e-3;  // [s]
  std::size_t muscle_;
  double rate_;  // [rad/s]
  double now_ = 0.0;
  bool placed_ = false;
};

}  // namespace

HiddenLaw command_slew() {
  HiddenLaw law;
  law.id = "command_slew";
  law.law = "references that follow no faster than a rate";
  law.sizes = {"slowness"};
  law.most = 10.0;
  law.places = muscle_places;
  law.draw = [](const auto&, const auto&, Random*) -> Parameters { return {{"slowness", 0.4}}; };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["slowness"] == 0.0) return;
    draft->command_laws.push_back(
        std::make_shared<Slew>(draft->muscle(h.place), 1.0 / h["slowness"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
