#pragma once

#include <string>
#include <vector>

#include "anthrob_sim/model/config_node.h"
#include "anthrob_sim/model/robot_model.h"

namespace anthrob {

/// Where an effect acts: the chain from the controller to the sensors, in this order.
enum class Seam {
  kController,
  kPowerStage,
  kMotor,
  kGear,
  kSpindle,
  kTendon,
  kSpring,
  kPath,
  kSkeleton,
  kJoints,
  kSensors
};
std::string seam_name(Seam seam);

/// When an effect is built in. Within a stage effects follow the chain, so that what is wrapped
/// round a component finds its numbers final.
enum class Stage {
  kSkeleton,    ///< bodies, joints and gravity, before the muscles are read
  kNumbers,     ///< numbers of components
  kParts,       ///< components exchanged for others, or added
  kComponents,  ///< wrapped round components, or beside them
};

/// One number of an effect.
struct EffectParameter {
  enum Kind {
    kSize,   ///< how much of the effect there is; none of it if all sizes are neutral
    kShape,  ///< how it looks; can be found out where there is some of it
    kGiven,  ///< cannot be told apart from a size: taken as known
  };
  std::string name, unit, meaning;
  double neutral = 0.0;  ///< of a size: no effect; of the others: what holds if none is given
  double typical = 0.0;  ///< plausible; typical - neutral is the unit dose of a screening
  Bounds bounds;
  Kind kind = kSize;
};

/// What the catalogue says about an effect.
struct EffectInfo {
  std::string id;           ///< fixed: in files, reports and on command lines
  std::string name;         ///< for people
  std::string description;  ///< one paragraph
  std::string equation;
  std::string source;
  std::string where;  ///< kinds of places, "MUSCLE | all"
  Seam seam = Seam::kJoints;
  Stage stage = Stage::kComponents;
  bool dissipates = false;
  bool slow = false;                  ///< builds up over minutes
  bool once_a_muscle = false;         ///< two of them would not add up
  std::vector<std::string> channels;  ///< in which it shows: position, current, force, joint, ...
  std::vector<EffectParameter> parameters;

  const EffectParameter* find(const std::string& parameter) const;
};

/// A robot while its effects are built in. Until Stage::kNumbers it has no muscles.
struct ModelDraft {
  RobotModel& robot;
  SkeletonModel& skeleton;  ///< the robot's own
};

class EffectSetting;

/// A way in which a robot may differ from its plain model. Immutable; one object for all robots.
class Effect {
 public:
  explicit Effect(EffectInfo info) : info_(std::move(info)) {}
  virtual ~Effect() = default;

  const EffectInfo& info() const { return info_; }

  /// Where it can sit on this robot; empty if nowhere.
  virtual std::vector<std::string> places(const RobotModel& robot) const = 0;
  /// Its parameters at one of these places: units, typical values and bounds may depend on it.
  virtual std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                                     const std::string& place) const;
  /// Changes the robot at a place from `places`, by parameters within bounds that are not neutral.
  virtual void build_in(const EffectSetting& setting, ModelDraft& draft) const = 0;

 private:
  EffectInfo info_;
};

/// An effect with a place and all its numbers, ready to be built in.
class EffectSetting {
 public:
  /// @param origin where it was asked for, for messages
  /// @throws BadInput for unknown parameters, values out of bounds, or if no size is given
  EffectSetting(const Effect& effect, EffectInstance instance,
                std::vector<EffectParameter> parameters, const ConfigNode& origin);

  const Effect& effect() const { return *effect_; }
  const EffectInstance& instance() const { return instance_; }
  const std::string& id() const { return instance_.id; }
  const std::string& place() const { return instance_.place; }
  /// All sizes are neutral: the plain model.
  bool neutral() const;
  double operator[](const std::string& parameter) const;

  /// @throws BadInput always, one line, about one of its keys
  [[noreturn]] void fail(const std::string& key, const std::string& expectation) const;

 private:
  const Effect* effect_;
  EffectInstance instance_;
  std::vector<EffectParameter> parameters_;
  std::vector<double> values_;
  ConfigNode origin_;
};

}  // namespace anthrob
