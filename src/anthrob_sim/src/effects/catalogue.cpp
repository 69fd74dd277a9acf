#include "anthrob_sim/effects/catalogue.h"

#include <dlfcn.h>
#include <link.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <sstream>

#include "anthrob_core/errors.h"
#include "effects/trusted_libraries.h"

namespace anthrob {

namespace {

/// Built by the first registration: registrations run before main, in any order.
struct Registry {
  std::mutex mutex, loading;  // two, for loading registers
  std::multimap<std::string, const Effect*> effects;
  std::map<std::string, void*> libraries;
};

Registry& registry() {
  static Registry instance;
  return instance;
}

/// Keys of an entry of `effects:` that are no parameters.
bool is_parameter(const std::string& key) {
  return key != "id" && key != "place";
}

EffectSetting read_entry(const ConfigNode& node, const RobotModel& robot) {
  EffectInstance instance{node.text("id"), node.text("place"), {}};
  const Effect* effect = find_effect(instance.id);
  if (!effect) node.at("id").fail_expected("the id of an effect; anthrob_effects lists them");
  const auto parameters = effect->parameters_at(robot, instance.place);
  for (const auto& [key, value] : node.entries()) {
    if (!is_parameter(key)) continue;
    const EffectParameter* parameter = effect->info().find(key);
    if (!parameter) value.fail("unknown key: no parameter of " + instance.id);
    std::string unit = parameter->unit;
    for (const EffectParameter& there : parameters) {
      if (there.name == parameter->name) unit = there.unit;  // of a slide: N, not Nm
    }
    instance.parameters[key] = value.as_number(Bounds::any(), unit);
  }
  return EffectSetting(*effect, instance, parameters, node);
}

void check_place(const EffectSetting& setting, const RobotModel& robot) {
  const std::vector<std::string> places = setting.effect().places(robot);
  if (std::find(places.begin(), places.end(), setting.place()) != places.end()) return;
  constexpr std::size_t kShortList = 15;
  std::string expectation =
      "a place of this effect on this robot (" + setting.effect().info().where + ")";
  if (places.empty()) {
    expectation += "; there is none";
  } else if (places.size() <= kShortList) {
    expectation += ":";
    for (const std::string& place : places) expectation += " " + place;
  } else {
    expectation += "; anthrob_effects " + setting.id() + " --model FILE lists them";
  }
  setting.fail("place", expectation);
}

/// In which order effects are built in. A tendon stretches by all that its spring and what lies
/// beside the spring carry, so it is built around them.
int place_in_chain(Seam seam) {
  return seam == Seam::kTendon ? 2 * static_cast<int>(Seam::kSpring) + 1
                               : 2 * static_cast<int>(seam);
}

/// At `all` and at a muscle, where two of them would not add up.
void refuse_twice_on_a_muscle(const EffectSetting& setting,
                              const std::vector<EffectSetting>& settings) {
  if (!setting.effect().info().once_a_muscle || setting.place() == "all") return;
  for (const EffectSetting& other : settings) {
    if (other.id() != setting.id() || other.place() != "all") continue;
    setting.fail(
        "place",
        "this effect only once per muscle; the entry at 'all' already includes this muscle");
  }
}

}  // namespace

std::vector<const Effect*> all_effects() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  std::vector<const Effect*> list;
  for (const auto& entry : registry().effects) list.push_back(entry.second);
  return list;
}

const Effect* find_effect(const std::string& id) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  const auto range = registry().effects.equal_range(id);
  if (range.first == range.second) return nullptr;
  if (std::next(range.first) != range.second) {
    throw BadInput("effect " + id + ": registered twice; expected it in one library only");
  }
  return range.first->second;
}

EffectRegistration::EffectRegistration(std::unique_ptr<const Effect> effect)
    : effect_(std::move(effect)) {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  registry().effects.emplace(effect_->info().id, effect_.get());
}

EffectRegistration::~EffectRegistration() {
  const std::lock_guard<std::mutex> lock(registry().mutex);
  auto& effects = registry().effects;
  for (auto it = effects.begin(); it != effects.end(); ++it) {
    if (it->second != effect_.get()) continue;
    effects.erase(it);
    return;
  }
}

void load_effect_library(const std::string& library, const ConfigNode& origin) {
  std::string file =
      library.find_first_of("/.") == std::string::npos ? "lib" + library + ".so" : library;
  // Like all files that a model names.
  if (file.find('/') != std::string::npos) {
    const auto folder = std::filesystem::absolute(origin.file()).parent_path();
    file = (folder / file).lexically_normal().string();
  }
  const char* trusted = std::getenv(kTrustedLibraries);
  if (!is_trusted(library, file, trusted ? trusted : "")) {
    origin.fail(library +
                ": this model asks for code of another origin; if you trust it, allow it in the "
                "environment: " +
                kTrustedLibraries + "=" + library);
  }
  const std::lock_guard<std::mutex> lock(registry().loading);
  if (registry().libraries.count(file)) return;
  void* handle = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!handle) {
    origin.fail_expected(std::string("a library with effects, built and on LD_LIBRARY_PATH (") +
                         dlerror() + ")");
  }
  registry().libraries[file] = handle;
}

std::vector<std::string> effect_library_files() {
  const std::lock_guard<std::mutex> lock(registry().loading);
  std::vector<std::string> files;
  for (const auto& [name, handle] : registry().libraries) {
    link_map* loaded = nullptr;
    if (dlinfo(handle, RTLD_DI_LINKMAP, &loaded) == 0) files.emplace_back(loaded->l_name);
  }
  return files;
}

std::vector<EffectSetting> read_effects(const ConfigNode& config,
                                        const std::vector<EffectInstance>& more,
                                        const RobotModel& robot) {
  if (config.has("effect_libraries")) {
    for (const ConfigNode& node : config.at("effect_libraries").items()) {
      load_effect_library(node.as_text(), node);
    }
  }
  std::vector<EffectSetting> settings;
  if (config.has("effects")) {
    for (const ConfigNode& node : config.at("effects").items()) {
      settings.push_back(read_entry(node, robot));
    }
  }
  for (const EffectInstance& instance : more) {
    const Effect* effect = find_effect(instance.id);
    if (!effect) {
      config.fail("effect '" + instance.id + "': expected the id of an effect; anthrob_effects " +
                  "lists them");
    }
    settings.emplace_back(*effect, instance, effect->parameters_at(robot, instance.place), config);
  }
  const auto order = [](const EffectSetting& s) {
    const EffectInfo& info = s.effect().info();
    return std::make_tuple(info.stage, place_in_chain(info.seam), s.id(), s.place());
  };
  std::stable_sort(
      settings.begin(), settings.end(),
      [&](const EffectSetting& a, const EffectSetting& b) { return order(a) < order(b); });
  for (std::size_t i = 1; i < settings.size(); ++i) {
    if (order(settings[i - 1]) == order(settings[i])) {
      settings[i].fail("place",
                       "an effect only once per place; another entry has the same id and place");
    }
  }
  for (const EffectSetting& setting : settings) refuse_twice_on_a_muscle(setting, settings);
  return settings;
}

void build_in(const std::vector<EffectSetting>& settings, Stage stage, ModelDraft& draft) {
  const auto comes_now = [&](const EffectSetting& setting) {
    return setting.effect().info().stage == stage;
  };
  // An effect must not make a place for another one beside it, as a base tilted about x would for a
  // tilt about z; nor must it take one away.
  for (const EffectSetting& setting : settings) {
    if (comes_now(setting)) check_place(setting, draft.robot);
  }
  for (const EffectSetting& setting : settings) {
    if (!comes_now(setting)) continue;
    check_place(setting, draft.robot);
    if (!setting.neutral()) setting.effect().build_in(setting, draft);
  }
}

std::string effects_yaml(const std::vector<EffectInstance>& effects) {
  std::ostringstream out;
  out.precision(17);
  out << "effects:\n";
  for (const EffectInstance& effect : effects) {
    YAML::Emitter place;  // links have any names
    const bool plain = std::all_of(effect.place.begin(), effect.place.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '/';
    });
    if (!plain) place << YAML::DoubleQuoted;
    place << effect.place;
    out << "  - {id: " << effect.id << ", place: " << place.c_str();
    for (const auto& [name, value] : effect.parameters) out << ", " << name << ": " << value;
    out << "}\n";
  }
  return out.str();
}

}  // namespace anthrob
