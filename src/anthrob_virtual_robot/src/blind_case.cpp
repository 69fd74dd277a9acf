#include "blind_case.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "channels.h"
#include "dosing.h"
#include "places.h"

namespace anthrob::virtual_robot {
namespace {

// Streams of random numbers, so that one draw does not move another.
enum Stream : std::uint64_t {
  kPlace,
  kParameters,
  kSize,
  kNuisance,
  kTrain,
  kTest,
  kVariant = 7  // of robots that are in published studies
};

/// Of an effect that a calibration may partly correct at least half is left.
constexpr double kBeyond = 2.0;
/// A dose ends within 0.12 of its target; a little more is let pass. A logarithm.
constexpr double kRoughly = 0.18;
constexpr double kNothing = 1e-6;  ///< [sensor errors]
/// So many places of a law are tried if its size is drawn: slow ones take minutes at each.
constexpr std::size_t kMostPlaces = 6;
/// Laws and places of a pair are drawn so often; then they are taken as they come.
constexpr int kMostDraws = 100;

constexpr std::pair<const char*, CaseKind> kKinds[] = {{"effect", CaseKind::kEffect},
                                                       {"null", CaseKind::kNull},
                                                       {"pair", CaseKind::kPair},
                                                       {"outside", CaseKind::kOutside},
                                                       {"wrapped", CaseKind::kWrapped}};

Draft draft_of(const BlindCase& blind, const std::vector<Hidden>& hidden, std::uint64_t run) {
  Draft draft;
  draft.arm = blind.built;
  draft.run = run;
  for (const Hidden& one : hidden) build_in(one, &draft);
  return draft;
}

/// The robot without them, but for what a calibration may correct of what they change.
Draft ordinary_draft_of(const BlindCase& blind, const std::vector<Hidden>& hidden) {
  Draft draft;
  draft.arm = blind.built;
  for (const Hidden& one : hidden) {
    const HiddenLaw& law = hidden_law(one.id);
    if (law.ordinary) law.ordinary(one, &draft);
  }
  return draft;
}

std::vector<Command> commands_of(const BlindCase& blind, double seconds, std::uint64_t stream) {
  return excitation(blind.believed, seconds, Random(blind.seed, stream));
}

double train_seconds(const BlindCase& blind, const CaseSettings& settings) {
  return blind.slow ? settings.slow_train : settings.train;
}

/// What hidden things change in train_0 without noise, by runs with and without. What they change
/// that a calibration corrects is in both.
class Change {
 public:
  Change(const BlindCase& blind, const CaseSettings& settings)
      : blind_(blind),
        settings_(settings),
        seconds_(train_seconds(blind, settings)),
        commands_(commands_of(blind, seconds_, kTrain)),
        plain_(run(draft_of(blind, {}, 0))) {}
  /// Of every channel [sensor errors].
  std::map<std::string, double> of(const std::vector<Hidden>& hidden) const {
    const bool ordinary_too = std::any_of(hidden.begin(), hidden.end(), [](const Hidden& one) {
      return static_cast<bool>(hidden_law(one.id).ordinary);
    });
    const Recording with = run(draft_of(blind_, hidden, 0));
    return difference(with, ordinary_too ? run(ordinary_draft_of(blind_, hidden)) : plain_,
                      blind_.built, blind_.sensors);
  }

 private:
  Recording run(Draft draft) const {
    Robot robot(std::move(draft), nullptr, 0);
    return record(&robot, commands_, seconds_, settings_.recording);
  }

  const BlindCase& blind_;
  const CaseSettings& settings_;
  double seconds_;
  std::vector<Command> commands_;
  Recording plain_;
};

/// All places of a law in an order that the seed shuffles, for each law anew.
std::vector<std::string> shuffled_places(const HiddenLaw& law, const reference::ArmParameters& arm,
                                         std::uint64_t seed) {
  std::vector<std::string> places = law.places(arm);
  std::vector<std::string> ids;
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& other : *laws) ids.push_back(other.id);
  }
  const auto number = std::find(ids.begin(), ids.end(), law.id) - ids.begin();
  Random random(1009 * seed + static_cast<std::uint64_t>(number), kPlace);
  for (std::size_t i = places.size(); i > 1; --i) std::swap(places[i - 1], places[random.below(i)]);
  return places;
}

/// How far an ordinary calibration may move what a hidden thing adds to, in its direction.
double correctable(const std::vector<ModelParameter>& ordinary, const Hidden& hidden) {
  const HiddenLaw& law = hidden_law(hidden.id);
  if (!law.same_as) return 0.0;
  const std::string path = law.same_as->path(hidden.place);
  for (const ModelParameter& p : ordinary) {
    if (p.path != path) continue;
    return hidden[law.sizes.front()] > 0.0 ? p.upper - p.initial : p.initial - p.lower;
  }
  return 0.0;
}

/// A hidden thing, and what it alone changes in every channel [sensor errors].
struct Sized {
  Hidden hidden;
  std::map<std::string, double> change;

  /// By what factor the worst channel changes less than cases ask for, or more, if the size is
  /// drawn; a logarithm, 0 if it does neither.
  double off(const CaseSettings& settings) const {
    const double worst_change = std::max(worst(change).second, kNothing);
    const double less = std::log(settings.least_change / worst_change);
    if (hidden_law(hidden.id).sizes.empty()) return std::max(less, 0.0);
    const double more = std::log(worst_change / settings.most_change);
    return std::max({less, more, 0.0}) <= kRoughly ? 0.0 : std::max(less, more);
  }
};

/// Of such a size that the worst channel changes by a target, as nearly as plausible sizes let it.
Sized sized(const Change& change, const CaseSettings& settings, const Hidden& hidden,
            Random* random) {
  const HiddenLaw& law = hidden_law(hidden.id);
  const double target = random->log_uniform(settings.least_change, settings.most_change);
  if (law.sizes.empty()) return {hidden, change.of({hidden})};
  const double least = std::max(law.least, kBeyond * correctable(settings.ordinary, hidden) /
                                               std::abs(hidden[law.sizes.front()]));
  std::map<double, std::map<std::string, double>> tried;
  const auto worst_of = [&](double factor) {
    tried[factor] = change.of({scaled(hidden, factor)});
    return worst(tried[factor]).second;
  };
  const double factor = dose(worst_of, target, least, std::max(least, law.most));
  return {scaled(hidden, factor), tried.at(factor)};
}

/// What makes one null harder than another.
void vary_null(std::uint64_t number, BlindCase* blind) {
  Random random(blind->seed, kVariant);
  SensorSettings& s = blind->sensors;
  if (number % 2 == 1) blind->stated_noise = random.uniform() < 0.5 ? 0.8 : 1.2;
  for (SensorErrors* errors :
       {&s.position, &s.velocity, &s.current, &s.force, &s.elbow, &s.shoulder}) {
    if (number % 4 >= 2) errors->memory = 0.02;
    if (number % 8 >= 4) errors->quantum *= 3.0;
  }
}

BlindCase empty_case(CaseKind kind, std::uint64_t seed, const reference::ArmParameters& believed,
                     const CaseSettings& settings) {
  BlindCase blind;
  blind.kind = kind;
  blind.seed = seed;
  blind.believed = believed;
  blind.built = miscalibrated(believed, settings.nuisances, Random(seed, kNuisance));
  blind.sensors = settings.sensors;
  return blind;
}

/// @return what is hidden now, of a typical size
Hidden& hide(const HiddenLaw& law, const std::string& place, Random* random, BlindCase* blind) {
  // One and the same number has no error of calibration beside the effect: it is found whole.
  if (law.same_as) law.same_as->in(&blind->built, place) = law.same_as->in(&blind->believed, place);
  blind->hidden.push_back({law.id, place, law.draw(blind->built, place, random)});
  blind->slow = blind->slow || law.slow;
  return blind->hidden.back();
}

/// The same of a size that is drawn. @return how far off what cases ask for (Sized::off)
double hide_sized(const HiddenLaw& law, const std::string& place, const CaseSettings& settings,
                  Random* random, Random* sizes, BlindCase* blind) {
  Hidden& hidden = hide(law, place, random, blind);
  const Sized drawn = sized(Change(*blind, settings), settings, hidden, sizes);
  hidden = drawn.hidden;
  blind->change = drawn.change;
  return drawn.off(settings);
}

/// At the first of its places at which it changes what cases ask for, counted from another one for
/// each k; if it does at none of those that are tried, where it comes closest to that.
BlindCase with_effect(const BlindCase& bare, const HiddenLaw& law, std::uint64_t k,
                      std::uint64_t seed, const CaseSettings& settings) {
  const std::vector<std::string> places = shuffled_places(law, bare.built, seed);
  const std::size_t count = places.size();
  // By turns in both halves, so that of many places two turns hardly try the same ones.
  const std::size_t first = k % 2 * (count / 2) + k / 2;
  const std::size_t tried = law.sizes.empty() ? count : std::min(count, kMostPlaces);
  BlindCase best;
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < tried && least > 0.0; ++i) {
    BlindCase blind = bare;
    Random random(blind.seed, kParameters), sizes(blind.seed, kSize);
    const std::string& place = places[(first + i) % count];
    const double off = hide_sized(law, place, settings, &random, &sizes, &blind);
    if (off >= least) continue;
    least = off;
    best = std::move(blind);
  }
  return best;
}

/// Two quick ones of different ids, each where it changes what cases ask for.
BlindCase with_pair(const BlindCase& bare, std::uint64_t seed, const CaseSettings& settings) {
  BlindCase blind = bare;
  Random random(blind.seed, kParameters), sizes(blind.seed, kSize);
  const auto& laws = catalogue_laws();
  for (int draw = 0; blind.hidden.size() < 2; ++draw) {
    const HiddenLaw& law = laws[random.below(laws.size())];
    if (law.slow || law.sizes.empty()) continue;
    if (!blind.hidden.empty() && blind.hidden.front().id == law.id) continue;
    const std::vector<std::string> places = shuffled_places(law, blind.built, seed);
    const std::string& place = places[random.below(1000) % places.size()];
    BlindCase more = blind;
    const double off = hide_sized(law, place, settings, &random, &sizes, &more);
    if (off == 0.0 || draw >= kMostDraws) blind = std::move(more);
  }
  blind.change = Change(blind, settings).of(blind.hidden);
  return blind;
}

/// @return what a score takes such a case for
CaseKind kind_of(const std::vector<std::pair<std::string, std::string>>& laws_and_places) {
  if (laws_and_places.empty()) return CaseKind::kNull;
  if (laws_and_places.size() > 1) return CaseKind::kPair;
  for (const HiddenLaw& law : outside_laws()) {
    if (law.id == laws_and_places.front().first) return CaseKind::kOutside;
  }
  return CaseKind::kEffect;
}

}  // namespace

CaseKind case_kind(const std::string& name) {
  for (const auto& [text, kind] : kKinds) {
    if (name == text) return kind;
  }
  std::string kinds;
  for (const auto& [text, kind] : kKinds) kinds += (kinds.empty() ? "" : ", ") + std::string(text);
  throw std::invalid_argument("--kind " + name + ": expected one of: " + kinds);
}

std::string word(CaseKind wanted) {
  for (const auto& [text, kind] : kKinds) {
    if (wanted == kind) return text;
  }
  return "";
}

CaseSettings CaseSettings::load(const std::string& file) {
  const ConfigNode node = ConfigNode::load(file);
  CaseSettings settings;
  settings.sensors = SensorSettings::load(node.at("sensors"));
  settings.nuisances = NuisanceRanges::load(node.at("nuisances"));
  const ConfigNode recordings = node.at("recordings");
  if (recordings.has("count")) settings.trains = recordings.at("count").as_integer(1, 9);
  settings.train = recordings.number("train", Bounds::positive(), "s");
  settings.test = recordings.number("test", Bounds::positive(), "s");
  settings.slow_train = recordings.number("slow_train", Bounds::positive(), "s");
  settings.slow_test = recordings.number("slow_test", Bounds::positive(), "s");
  const ConfigNode change = node.at("change");
  settings.least_change = change.number("least", Bounds::positive(), "1");
  settings.most_change = change.number("most", Bounds::positive(), "1");
  node.refuse_unknown_keys();
  return settings;
}

BlindCase draw_case(CaseKind kind, std::uint64_t number, std::uint64_t seed,
                    const reference::ArmParameters& believed, const CaseSettings& settings) {
  // Every case has an arm of its own.
  BlindCase blind =
      empty_case(kind, 1000003 * seed + 16 * number + static_cast<int>(kind), believed, settings);
  switch (kind) {
    case CaseKind::kNull:
      vary_null(number, &blind);
      return blind;
    case CaseKind::kEffect:
    case CaseKind::kOutside: {
      const auto& laws = kind == CaseKind::kOutside ? outside_laws() : catalogue_laws();
      return with_effect(blind, laws[number % laws.size()], number / laws.size(), seed, settings);
    }
    case CaseKind::kPair:
      return with_pair(blind, seed, settings);
    case CaseKind::kWrapped:
      break;
  }
  Random random(blind.seed, kParameters);
  for (const std::string& muscle : muscle_places(blind.built)) {
    hide(hidden_law("wrapping_surface"), muscle, &random, &blind);
  }
  blind.change = Change(blind, settings).of(blind.hidden);
  return blind;
}

BlindCase make_case(const std::vector<std::pair<std::string, std::string>>& laws_and_places,
                    std::uint64_t seed, const reference::ArmParameters& believed,
                    const CaseSettings& settings) {
  BlindCase blind = empty_case(kind_of(laws_and_places), seed, believed, settings);
  Random random(blind.seed, kParameters), sizes(blind.seed, kSize);
  for (const auto& [id, place] : laws_and_places) {
    const auto is_same = [&, i = id, p = place](const Hidden& h) {
      return h.id == i && h.place == p;
    };
    if (std::any_of(blind.hidden.begin(), blind.hidden.end(), is_same)) {
      throw std::invalid_argument(id + "@" + place + ": given twice; expected each once");
    }
    const HiddenLaw& law = hidden_law(id);
    const std::vector<std::string> places = law.places(blind.built);
    if (std::find(places.begin(), places.end(), place) == places.end()) {
      std::string possible;
      for (const std::string& one : places) possible += (possible.empty() ? "" : ", ") + one;
      throw std::invalid_argument(id + " cannot be hidden at " + place +
                                  "; expected one of: " + possible);
    }
    hide(law, place, &random, &blind);
  }
  const Change change(blind, settings);
  for (Hidden& hidden : blind.hidden) hidden = sized(change, settings, hidden, &sizes).hidden;
  if (!blind.hidden.empty()) blind.change = change.of(blind.hidden);
  return blind;
}

void record_case(const BlindCase& blind, const CaseSettings& settings, const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& muscle : blind.believed.muscles) names.push_back(muscle.name);
  // Scatter of a repeat by which the noise is estimated wrong.
  SensorSettings scattered = blind.sensors;
  const double scatter = std::sqrt(2.0 * blind.stated_noise * blind.stated_noise - 1.0);
  for (SensorErrors* errors : {&scattered.position, &scattered.velocity, &scattered.current,
                               &scattered.force, &scattered.elbow, &scattered.shoulder}) {
    errors->noise *= scatter;
  }
  Meta meta;
  meta.settle = settings.recording.settle;
  meta.sensors = blind.sensors.yaml();
  const double train = train_seconds(blind, settings);
  const double test = blind.slow ? settings.slow_test : settings.test;
  const auto run = [&](const std::string& name, double seconds, std::uint64_t stream,
                       std::uint64_t noise, const SensorSettings& sensors) {
    Robot robot(draft_of(blind, blind.hidden, noise), &sensors, blind.seed * 31 + noise);
    const std::vector<Command> commands = commands_of(blind, seconds, stream);
    write_dataset(record(&robot, commands, seconds, settings.recording), names, settings.recording,
                  meta, folder + "/" + name);
  };
  run("train_0", train, kTrain, 0, blind.sensors);
  run("repeat_0", train, kTrain, 1, scattered);
  run("test_0", test, kTest, 3, blind.sensors);
  // A slow effect needs one long recording rather than two.
  for (int k = 1; k < (blind.slow ? 1 : settings.trains); ++k) {
    const auto number = static_cast<std::uint64_t>(k);
    run("train_" + std::to_string(k), train, kTrain + 100 * number, 2 * number, blind.sensors);
  }
}

}  // namespace anthrob::virtual_robot
