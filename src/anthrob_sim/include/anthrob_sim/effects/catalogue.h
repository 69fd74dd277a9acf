#pragma once

#include <memory>
#include <string>
#include <vector>

#include "anthrob_sim/effects/effect.h"

namespace anthrob {

/// All effects that this program knows, sorted by id, including those of libraries loaded so far.
std::vector<const Effect*> all_effects();
/// The effect of this id; null if there is none.
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

/// Loads a shared library with additional effects.
/// @param library a path (relative to the folder of the file that names it), or a name that the
/// loader finds on LD_LIBRARY_PATH ("my_effects" means libmy_effects.so)
/// @param origin entry of the file that names it, for error messages
/// @throws BadInput if it cannot be loaded
void load_effect_library(const std::string& library, const ConfigNode& origin);
/// Paths of the effect libraries that were loaded.
std::vector<std::string> effect_library_files();

/// Reads the effects of a model file and adds those of the caller (neutral ones included). The
/// result is in the order in which they are built in, independently of the order of the request.
/// @param more effects of the caller   @param robot its skeleton must be complete
/// @throws BadInput with one line for unknown ids and parameters, values out of bounds, and effects
/// that stand twice at a place
std::vector<EffectSetting> read_effects(const ConfigNode& config,
                                        const std::vector<EffectInstance>& more,
                                        const RobotModel& robot);

/// Builds the effects of one stage into the model.
/// @throws BadInput if an effect cannot act at its place on this robot
void build_in(const std::vector<EffectSetting>& settings, Stage stage, ModelDraft& draft);

/// YAML text of effects, as they stand in a model file: "effects:\n  - {id: ..., place: ...,
/// ...}\n".
std::string effects_yaml(const std::vector<EffectInstance>& effects);

}  // namespace anthrob
