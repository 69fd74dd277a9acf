#include <algorithm>

#include "anthrob_sim/effects/motor_effect.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "supply_sag";
  i.name = "Supply voltage sag";
  i.description =
      "Battery and cables have a resistance that several motors share: each motor gets less "
      "voltage when all of them pull. A bridge passes on the share d of the supply voltage that "
      "its controller asks for, and draws the same share of its motor's current. V_0 is the "
      "nominal voltage. The sum runs over the motors of the ECU or of the robot. The equation is "
      "solved together with the change of the currents within the step.";
  i.equation = "V_motor = d (V_0 - resistance sum d i), d = V / V_0";
  i.source = "known: 20-200 mohm";
  i.where = "ecu_k | global";
  i.seam = Seam::kPowerStage;
  i.dissipates = true;
  i.channels = {"current", "velocity", "position"};
  i.parameters = {{"resistance", "ohm", "of supply and cables", 0.0, 0.2, {0.0, 10.0}}};
  return i;
}

class Supply final : public PowerEffect {
 public:
  struct User {
    std::size_t muscle;
    double nominal;      ///< [V]
    double conductance;  ///< GearedMotor::conductance() [A/V]
  };
  Supply(std::vector<User> users, double resistance)
      : users_(std::move(users)), resistance_(resistance) {}

  /// Voltages of the motors in the last step.
  std::size_t state_size() const override { return users_.size(); }
  void reset(StateView state) const override { std::fill_n(state.data(), users_.size(), 0.0); }

  /// A motor's current follows its voltage within a step. With that of the step before, a large
  /// resistance would make the supply swing from step to step; the sum is linear in what it loses.
  void apply(std::vector<PowerLine>& lines, StateView state) const override {
    double drawn = 0.0, follows = 0.0;
    for (std::size_t u = 0; u < users_.size(); ++u) {
      const User& user = users_[u];
      const PowerLine& line = lines[user.muscle];
      const double duty = line.voltage / user.nominal;
      drawn += duty * (line.current + user.conductance * (line.voltage - state[u]));
      follows += duty * duty * user.conductance;
    }
    const double current = drawn / (1.0 + resistance_ * follows);
    for (std::size_t u = 0; u < users_.size(); ++u) {
      double& voltage = lines[users_[u].muscle].voltage;
      voltage *= std::max(0.0, 1.0 - resistance_ * current / users_[u].nominal);
      state[u] = voltage;
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
    bool any = false;
    for (const MuscleModel& muscle : robot.muscles) {
      if (!muscle.motor()) continue;
      any = true;
      if (muscle.ecu.empty()) continue;
      if (std::find(list.begin(), list.end(), muscle.ecu) == list.end()) list.push_back(muscle.ecu);
    }
    if (any) list.push_back("global");
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    std::vector<Supply::User> users;
    for (std::size_t i = 0; i < draft.robot.muscles.size(); ++i) {
      const MuscleModel& muscle = draft.robot.muscles[i];
      const GearedMotor* motor = muscle.motor();
      if (!motor) continue;
      if (setting.place() != "global" && setting.place() != muscle.ecu) continue;
      users.push_back({i, motor->input_high(), motor->conductance()});
    }
    draft.robot.power_effects.push_back(std::make_shared<Supply>(users, setting["resistance"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<SupplySag>());

}  // namespace
}  // namespace anthrob
