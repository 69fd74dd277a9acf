#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

/// A supply with a capacitor: its voltage follows the load with a time constant.
class Supply final : public PowerLaw {
 public:
  Supply(std::vector<std::size_t> motors, double nominal, double resistance)
      : motors_(std::move(motors)), nominal_(nominal), resistance_(resistance) {}
  void apply(double seconds, const Readings& now, std::vector<double>* voltages) override {
    double load = 0.0;
    for (const std::size_t i : motors_) {
      load += now.muscles[i].current * (*voltages)[i] / nominal_;
    }
    const double keep = std::exp(-seconds / kCapacitor);
    lost_ = keep * lost_ + (1.0 - keep) * resistance_ * load;
    for (const std::size_t i : motors_) (*voltages)[i] *= 1.0 - lost_ / nominal_;
  }

 private:
  static constexpr double kCapacitor = 0.004;  // [s]
  std::vector<std::size_t> motors_;
  double nominal_, resistance_;
  double lost_ = 0.0;  // [V]
};

/// Muscles of the ECUs of Anthrob, two each in the order of the model, the last one alone.
std::vector<std::size_t> motors_of(const std::string& place, std::size_t count) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < count; ++i) {
    if (place == "global" || place == "ecu_" + std::to_string(1 + i / 2)) list.push_back(i);
  }
  return list;
}

}  // namespace

HiddenLaw supply_sag() {
  HiddenLaw law;
  law.id = "supply_sag";
  law.law = "with a capacitor of 4 ms";
  law.sizes = {"resistance"};
  law.most = 20.0;
  law.places = [](const reference::ArmParameters& arm) {
    std::vector<std::string> list{"global"};
    for (std::size_t k = 0; 2 * k < arm.muscles.size(); ++k) {
      list.push_back("ecu_" + std::to_string(k + 1));
    }
    return list;
  };
  law.draw = [](const auto&, const std::string& place, Random*) -> Parameters {
    return {{"resistance", place == "global" ? 0.1 : 0.3}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    draft->power_laws.push_back(std::make_shared<Supply>(
        motors_of(h.place, draft->arm.muscles.size()),
        draft->arm.muscles.front().controller.voltage_limit, h["resistance"]));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
