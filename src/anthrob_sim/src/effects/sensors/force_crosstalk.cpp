#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace {

EffectInfo describe() {
  EffectInfo i;
  i.id = "force_crosstalk";
  i.name = "Crosstalk between force sensors";
  i.description =
      "The channel of one force sensor picks up a share of another sensor's force: the measured "
      "force of a resting muscle follows that of its neighbour. What a channel picks up is not "
      "passed on to further channels. The controller sees the error, too.";
  i.equation = "f_read(TO) = f(TO) + sum over FROM of share f(FROM)";
  i.source = "known: 0.5-3 %";
  i.where = "TO/FROM (muscles)";
  i.seam = Seam::kSensors;
  i.channels = {"force"};
  i.parameters = {{"share", "1", "of the other's force", 0.0, 0.02, {-0.5, 0.5}}};
  return i;
}

/// All of a robot's: each pair takes the force as it is before any cross-talk.
class Crosstalk final : public ReadingEffect {
 public:
  struct Pair {
    int to, from;
    double share;
  };
  explicit Crosstalk(std::vector<Pair> pairs) : pairs_(std::move(pairs)) {}

  const std::vector<Pair>& pairs() const { return pairs_; }
  /// What each pair picks up [N].
  std::size_t state_size() const override { return pairs_.size(); }
  void apply(Readings& readings, StateView state) const override {
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      state[i] = pairs_[i].share * readings.muscles[pairs_[i].from].force;
    }
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      readings.muscles[pairs_[i].to].force += state[i];
    }
  }

 private:
  std::vector<Pair> pairs_;
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
    std::vector<Crosstalk::Pair> pairs;
    auto& effects = draft.robot.reading_effects;
    // Effects of one kind follow each other.
    if (!effects.empty()) {
      if (const auto* before = dynamic_cast<const Crosstalk*>(effects.back().get())) {
        pairs = before->pairs();
        effects.pop_back();
      }
    }
    pairs.push_back(
        {draft.robot.find_muscle(place[0]), draft.robot.find_muscle(place[1]), setting["share"]});
    effects.push_back(std::make_shared<Crosstalk>(std::move(pairs)));
  }
};

const EffectRegistration kRegistration(std::make_unique<ForceCrosstalk>());

}  // namespace
}  // namespace anthrob
