#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_sim/effects/effect.h"

namespace anthrob {

/// All effects this program knows, by id. Those of libraries loaded meanwhile are among them.
std::vector<const Effect*> all_effects();
/// Null if there is none.
const Effect* find_effect(const std::string& id);

/// Puts an effect into the catalogue as long as its library is loaded. In the effect's source file:
///   const EffectRegistration kRegistration(std::make_unique<MyEffect>());
class EffectRegistration {
 public:
  explicit EffectRegistration(std::unique_ptr<const Effect> effect);
  ~EffectRegistration();
  EffectRegistration(const EffectRegistration&) = delete;
  EffectRegistration& operator=(const EffectRegistration&) = delete;

 private:
  std::unique_ptr<const Effect> effect_;
};

/// Loads a library with effects of one's own: a path, from the folder of the file that names it, or
/// a name that the loader finds ("my_effects" is libmy_effects.so).
/// @param origin where it is named  @throws BadInput if it cannot be loaded
void load_effect_library(const std::string& library, const ConfigNode& origin);
/// Where the loader found those that were loaded.
std::vector<std::string> effect_library_files();

/// The effects that a model file and a caller ask for, neutral ones too, in the order in which
/// they are built in; this does not depend on the order in which they are asked for.
/// @param robot its skeleton must be there
/// @throws BadInput with one line: unknown ids and parameters, values out of bounds, doubles
std::vector<EffectSetting> read_effects(const ConfigNode& config,
                                        const std::vector<EffectInstance>& more,
                                        const RobotModel& robot);

/// Builds in those of one stage.
/// @throws BadInput if a place is none of the effect's places on this robot
void build_in(const std::vector<EffectSetting>& settings, Stage stage, ModelDraft& draft);

/// The effects as a model file lists them: "effects:\n  - {id: ..., place: ..., ...}\n".
std::string effects_yaml(const std::vector<EffectInstance>& effects);

}  // namespace anthrob
