#include "fit/candidate.h"

#include <algorithm>
#include <cmath>

#include "anthrob_core/errors.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/effects/placed_effects.h"

namespace anthrob {
namespace discovery {

namespace {

/// The key path of a model file that an effect's size adds to; empty if there is none.
std::string same_quantity(const std::string& id, const std::string& place) {
  const std::vector<std::string> words = split_place(place);
  if (id == "joint_viscous") return "joints." + place + ".friction.viscous";
  if (id == "via_point_shift" && words.size() == 3) {
    return "muscles." + words[0] + ".path." + words[1] + ".point." +
           std::to_string(words[2][0] - 'x');
  }
  return "";
}

}  // namespace

std::string Candidate::owner() const {
  return split_place(place).front();
}

EffectInstance Candidate::neutral() const {
  EffectInstance instance{effect->info().id, place, {}};
  for (const EffectParameter& p : parameters) {
    instance.parameters[p.name] = p.kind == EffectParameter::kSize ? p.neutral : p.typical;
  }
  return instance;
}

EffectInstance Candidate::dose(const EffectParameter& size) const {
  EffectInstance instance = neutral();
  instance.parameters[size.name] = size.typical;
  return instance;
}

EffectInstance Candidate::sized(const std::vector<double>& doses) const {
  EffectInstance instance = neutral();
  const auto sizes = this->sizes();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const EffectParameter& p = *sizes[i];
    const double dose = p.typical - p.neutral, inside = 1e-3 * std::abs(dose);
    instance.parameters[p.name] =
        std::clamp(p.neutral + doses[i] * dose, p.bounds.lo + (p.bounds.lo_open ? inside : 0.0),
                   p.bounds.hi - (p.bounds.hi_open ? inside : 0.0));
  }
  return instance;
}

std::vector<const EffectParameter*> Candidate::sizes() const {
  std::vector<const EffectParameter*> found;
  for (const EffectParameter& p : parameters) {
    if (p.kind == EffectParameter::kSize) found.push_back(&p);
  }
  return found;
}

std::vector<Candidate> list_candidates(const Evaluator& evaluator,
                                       const std::vector<std::string>& ids) {
  const RobotModel& robot = *evaluator.model();
  for (const std::string& id : ids) {
    if (!find_effect(id)) {
      throw BadInput("--effects " + id +
                     ": no such effect; `rosrun anthrob_sim anthrob_effects` lists the ids");
    }
  }
  const auto has = [&](const std::string& id, const std::string& place) {
    return std::any_of(robot.effects.begin(), robot.effects.end(),
                       [&](const EffectInstance& e) { return e.id == id && e.place == place; });
  };
  std::vector<Candidate> candidates;
  const auto is_candidate = [&](const std::string& id) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& c) { return c.effect->info().id == id; });
  };
  for (const Effect* effect : all_effects()) {
    const std::string& id = effect->info().id;
    if (!ids.empty() && !std::count(ids.begin(), ids.end(), id)) continue;
    find_effect(id);  // one that is there twice is told, not taken for one that does nothing
    for (const std::string& place : effect->places(robot)) {
      if (has(id, place)) continue;
      Candidate candidate{effect, place, effect->parameters_at(robot, place), {}};
      const std::string path = same_quantity(id, place);
      const auto& nuisances = evaluator.nuisances();
      for (std::size_t i = 0; i < nuisances.size(); ++i) {
        if (nuisances[i].path == path) candidate.same_as.push_back(static_cast<int>(i));
      }
      candidates.push_back(std::move(candidate));
    }
  }
  for (const std::string& id : ids) {
    if (is_candidate(id)) continue;
    throw BadInput("--effects " + id + ": nowhere to look for it: the robot of " + robot.file +
                   " has no place for this effect, or the model contains it at every place "
                   "already");
  }
  return candidates;
}

}  // namespace discovery
}  // namespace anthrob
