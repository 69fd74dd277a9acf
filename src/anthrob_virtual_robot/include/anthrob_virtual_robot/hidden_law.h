#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anthrob_virtual_robot/draft.h"
#include "anthrob_virtual_robot/random.h"

namespace anthrob::virtual_robot {

using Parameters = std::map<std::string, double>;

/// One thing that a robot has and its model lacks.
struct Hidden {
  std::string id;
  std::string place;
  Parameters parameters;  ///< in the words and units of the effect catalogue where it has them

  double operator[](const std::string& name) const { return parameters.at(name); }
};

/// A number of the model file, "joints.elbow.friction.viscous", and where the arm keeps it.
struct ModelNumber {
  std::function<std::string(const std::string& place)> path;
  std::function<double&(reference::ArmParameters*, const std::string& place)> in;
};

/// A kind of hidden thing. Its law is this package's own: equations of the same name elsewhere may
/// differ, as a real robot's do from any catalogue's.
struct HiddenLaw {
  std::string id;
  std::string law;                 ///< one line: which law it is
  std::vector<std::string> sizes;  ///< parameters that say how much of it there is; 0 is none
  std::function<std::vector<std::string>(const reference::ArmParameters&)> places;
  /// A typical one of its kind.
  std::function<Parameters(const reference::ArmParameters&, const std::string& place, Random*)>
      draw;
  std::function<void(const Hidden&, Draft*)> build;
  /// Of what `build` changes that which an ordinary calibration corrects, alone; none: nothing.
  std::function<void(const Hidden&, Draft*)> ordinary = {};
  /// What the first size adds to, if it is the same quantity as a number of the model file. What
  /// an ordinary calibration may correct of it is no effect.
  std::optional<ModelNumber> same_as = {};
  double least = 0.02;   ///< smallest factor on the typical sizes that is still plausible
  double most = 5.0;     ///< largest one
  double neutral = 0.0;  ///< value of the sizes at which there is nothing
  bool slow = false;     ///< needs recordings of two minutes and more
};

/// Those of the effect catalogue's names.
const std::vector<HiddenLaw>& catalogue_laws();
/// Those that the effect catalogue knows nothing of.
const std::vector<HiddenLaw>& outside_laws();
/// Of either kind. @throws std::invalid_argument
const HiddenLaw& hidden_law(const std::string& id);

/// The same with its sizes `factor` times as far from neutral.
Hidden scaled(const Hidden& hidden, double factor);
void build_in(const Hidden& hidden, Draft* draft);

}  // namespace anthrob::virtual_robot
