#pragma once

#include "anthrob_sim/actuator/actuator.h"
#include "anthrob_sim/effects/effect.h"
#include "anthrob_sim/path/muscle_path.h"

namespace anthrob {

/// One base class for each kind of place. It lists the places of a robot at which an effect can
/// act, and finds the place again when the effect is built in. The place `all` means all muscles,
/// which share the parameters.

/// Whether a muscle has what an effect changes: drives have no spindle, tendon, spring and path.
bool acts_on(const EffectInfo& effect, const MuscleModel& muscle);

/// MUSCLE | all
class MuscleEffect : public Effect {
 public:
  using Effect::Effect;
  std::vector<std::string> places(const RobotModel& robot) const override;
  void build_in(const EffectSetting& setting, ModelDraft& draft) const override;

 protected:
  virtual bool fits(const MuscleModel&) const { return true; }
  /// @param muscle index among the robot's muscles
  virtual void change(const EffectSetting& setting, ModelDraft& draft,
                      std::size_t muscle) const = 0;
};

/// MUSCLE/k | MUSCLE | all: entries of muscle paths, numbered as in the model file, origin 0.
class PathEffect : public Effect {
 public:
  using Effect::Effect;
  std::vector<std::string> places(const RobotModel& robot) const override;
  void build_in(const EffectSetting& setting, ModelDraft& draft) const override;

 protected:
  /// @param inner neither origin nor insertion
  virtual bool fits(const PathObstacle& obstacle, bool inner) const = 0;
  virtual void change(const EffectSetting& setting, const RobotModel& robot,
                      PathObstacle& obstacle) const = 0;
};

/// JOINT. At a prismatic joint, torques and angles among the parameters become forces and lengths.
class JointEffect : public Effect {
 public:
  explicit JointEffect(EffectInfo what) : Effect(std::move(what)) {}
  std::vector<std::string> places(const RobotModel& robot) const override;
  std::vector<EffectParameter> parameters_at(const RobotModel& robot,
                                             const std::string& place) const override;
  void build_in(const EffectSetting& setting, ModelDraft& draft) const override;

 protected:
  virtual bool fits(const JointModel&) const { return true; }
  virtual void change(const EffectSetting& setting, ModelDraft& draft, JointModel& joint) const = 0;
};

/// global
class GlobalEffect : public Effect {
 public:
  using Effect::Effect;
  std::vector<std::string> places(const RobotModel& robot) const override;
};

/// x | y | z: axes of the world.
class WorldAxisEffect : public Effect {
 public:
  using Effect::Effect;
  std::vector<std::string> places(const RobotModel& robot) const override;

 protected:
  virtual bool fits(const RobotModel&, const Vec3& axis) const = 0;
  static Vec3 axis_of(const std::string& place);
};

/// Splits "a/b/c".
std::vector<std::string> split_place(const std::string& place);

}  // namespace anthrob
