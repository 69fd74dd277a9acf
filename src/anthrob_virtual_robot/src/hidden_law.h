#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "draft.h"
#include "random.h"

namespace anthrob::virtual_robot {

using Parameters = std::map<std::string, double>;

/// One effect that a robot has and its model lacks.
struct Hidden {
  std::string id;
  std::string place;
  Parameters parameters;  ///< names and units of the effect catalogue, if it has them

  double operator[](const std::string& name) const { return parameters.at(name); }
};

/// A number of the model file, "joints.elbow.friction.viscous", and where the arm keeps it.
struct ModelNumber {
  std::function<std::string(const std::string& place)> path;
  std::function<double&(reference::ArmParameters*, const std::string& place)> in;
};

/// A kind of hidden effect. This package has its own equations. They may differ from those of the
/// catalogue's effect of the same name, as those of a real robot would.
struct HiddenLaw {
  std::string id;
  std::string law;                 ///< one line that describes the law
  std::vector<std::string> sizes;  ///< parameters that give its size; 0: no effect
  std::function<std::vector<std::string>(const reference::ArmParameters&)> places;
  /// Draws typical parameters.
  std::function<Parameters(const reference::ArmParameters&, const std::string& place, Random*)>
      draw;
  std::function<void(const Hidden&, Draft*)> build;
  /// Applies only the part of `build` that an ordinary calibration corrects; empty: there is none.
  std::function<void(const Hidden&, Draft*)> ordinary = {};
  /// The number of the model file that the first size adds to, if it is the same quantity. The part
  /// of the size that an ordinary calibration may correct does not count as an effect.
  std::optional<ModelNumber> same_as = {};
  double least = 0.02;   ///< smallest factor on the typical sizes that is still plausible
  double most = 5.0;     ///< largest one
  double neutral = 0.0;  ///< value of the sizes without effect
  bool slow = false;     ///< needs recordings of two minutes and more
};

/// The laws that the effect catalogue has, too.
const std::vector<HiddenLaw>& catalogue_laws();
/// The laws that the effect catalogue lacks.
const std::vector<HiddenLaw>& outside_laws();
/// The law of this id, of either kind. @throws std::invalid_argument if there is none
const HiddenLaw& hidden_law(const std::string& id);

/// The same with its sizes `factor` times as far from neutral.
Hidden scaled(const Hidden& hidden, double factor);
void build_in(const Hidden& hidden, Draft* draft);

}  // namespace anthrob::virtual_robot
