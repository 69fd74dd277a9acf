#include <algorithm>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "supply_sag";
  i.name = "Supply that gives way";
  i.description =
      "Battery and cables have a resistance that several motors share: each gets less when all of "
      "them pull. A bridge passes on the share of the supply's voltage that its controller asks "
      "for, and draws that share of its motor's current.";
  i.equation =
      "V_motor = d (V_0 - resistance sum d i), d = V / V_0, V_0 the nominal voltage, sum over the "
      "motors of the ECU or of the robot";
  i.source = "known: 20-200 mohm";
  i.where = "ecu_k | global";
  i.seam = Seam::kPowerStage;
  i.dissipates = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {{"resistance", "ohm", "of supply and cables", 0.0, 0.3, {0.0, 10.0}}};
  return i;
}

bool has_motor(const MuscleModel& muscle) {
  return dynamic_cast<const GearedMotor*>(muscle.actuator.get()) != nullptr;
}

class Supply final : public PowerEffect {
 public:
  struct User {
    std::size_t muscle;
    double nominal;  ///< [V]
  };
  Supply(std::vector<User> users, double resistance)
      : users_(std::move(users)), resistance_(resistance) {}

  void apply(std::vector<PowerLine>& lines, StateView) const override {
    double current = 0.0;
    for (const User& user : users_) {
      current += lines[user.muscle].voltage / user.nominal * lines[user.muscle].current;
    }
    for (const User& user : users_) {
      lines[user.muscle].voltage *= std::max(0.0, 1.0 - resistance_ * current / user.nominal);
    }
  }

 private:
  std::vector<User> users_;
  double resistance_;
};

class SupplySag final : public Effect {
 public:
  SupplySag() : Effect(describe()) {}

  std::vector<std::string> places(const RobotModel& robot) const override {
    std::vector<std::string> list;
    for (const MuscleModel& muscle : robot.muscles) {
      if (!has_motor(muscle) || muscle.ecu.empty()) continue;
      if (std::find(list.begin(), list.end(), muscle.ecu) == list.end()) list.push_back(muscle.ecu);
    }
    if (!list.empty()) list.push_back("global");
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    std::vector<Supply::User> users;
    for (std::size_t i = 0; i < draft.robot.muscles.size(); ++i) {
      const MuscleModel& muscle = draft.robot.muscles[i];
      if (!has_motor(muscle)) continue;
      if (setting.place() != "global" && setting.place() != muscle.ecu) continue;
      users.push_back({i, muscle.actuator->input_high()});
    }
    draft.robot.power_effects.push_back(std::make_shared<Supply>(users, setting["resistance"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<SupplySag>());

}  // namespace
}  // namespace anthrob
