#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "force_crosstalk";
  i.name = "Cross-talk between force sensors";
  i.description =
      "The channel of one force sensor picks up a share of another's: a resting muscle's force "
      "moves with its neighbour's. The controller sees it too.";
  i.equation = "f_read(TO) = f(TO) + share f(FROM)";
  i.source = "known: 0.5-3 %";
  i.where = "TO/FROM (muscles)";
  i.seam = Seam::kSensors;
  i.channels = {"force"};
  i.parameters = {{"share", "1", "of the other's force", 0.0, 0.02, {-0.5, 0.5}}};
  return i;
}

class Crosstalk final : public ReadingEffect {
 public:
  Crosstalk(int to, int from, double share) : to_(to), from_(from), share_(share) {}
  void apply(Readings& readings, StateView) const override {
    readings.muscles[to_].force += share_ * readings.muscles[from_].force;
  }

 private:
  int to_, from_;
  double share_;
};

class ForceCrosstalk final : public Effect {
 public:
  ForceCrosstalk() : Effect(describe()) {}

  std::vector<std::string> places(const RobotModel& robot) const override {
    std::vector<std::string> list;
    for (const MuscleModel& to : robot.muscles) {
      for (const MuscleModel& from : robot.muscles) {
        if (to.name != from.name) list.push_back(to.name + "/" + from.name);
      }
    }
    return list;
  }

  void build_in(const EffectSetting& setting, ModelDraft& draft) const override {
    const std::vector<std::string> place = split_place(setting.place());
    draft.robot.reading_effects.push_back(std::make_shared<Crosstalk>(
        draft.robot.find_muscle(place[0]), draft.robot.find_muscle(place[1]), setting["share"]));
  }
};

const EffectRegistration kRegistration(std::make_unique<ForceCrosstalk>());

}  // namespace
}  // namespace anthrob
