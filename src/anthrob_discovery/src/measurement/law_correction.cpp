#include "measurement/law_correction.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "anthrob_core/text.h"
#include "measurement/leading_reference.h"
#include "measurement/stamp_report.h"

namespace anthrob {
namespace discovery {

namespace {

constexpr const char* kNumberNames[] = {"K_P", "K_D", "K_f", "offset"};
constexpr const char* kNumberUnits[] = {"V/rad", "Vs/rad", "V/N", "V"};

/// A number of the law that muscles share.
struct CommonNumber {
  LawNumber found;
  double model = 0.0;
  bool differs = false;
};

/// Muscles with one model number whose own numbers are alike, weighted by their errors.
std::optional<CommonNumber> common_number(const ControlLaw& law, std::size_t number,
                                          const ControllerAlgebraOptions& options) {
  CommonNumber common;
  common.model = law.muscles.front().model[number];
  double weights = 0.0, sum = 0.0;
  for (const MuscleLaw& muscle : law.muscles) {
    if (muscle.model[number] != common.model) return {};
    const double sigma = muscle.found[number].sigma;
    common.differs = common.differs || muscle.differs(number, options);
    if (!muscle.is_determined || !(sigma > 0.0)) continue;
    weights += 1.0 / (sigma * sigma), sum += muscle.found[number].value / (sigma * sigma);
  }
  if (!(weights > 0.0)) return {};
  common.found = {sum / weights, 1.0 / std::sqrt(weights)};
  for (const MuscleLaw& muscle : law.muscles) {
    const LawNumber& own = muscle.found[number];
    if (!muscle.is_determined || !(own.sigma > 0.0)) continue;
    const double away = std::abs(own.value - common.found.value);
    if (away > options.sure * own.sigma && away * muscle.voltages[number] > options.least_law) {
      return {};
    }
  }
  return common;
}

class LawReport {
 public:
  LawReport(const ControllerAlgebraOptions& options, Description& description)
      : options_(options), description_(description) {}

  void add_form(const ControlLaw& law) {
    switch (law.form) {
      case LawForm::kModel:
        break;
      case LawForm::kDerivativeOnError:
        on_error();
        break;
      case LawForm::kFilteredDerivative:
        filter("derivative filter", "the derivative", law.time_constant);
        break;
      case LawForm::kFilteredDerivativeOnError:
        filter("derivative filter", "the derivative", law.time_constant);
        on_error();
        break;
      case LawForm::kFilteredVoltage:
        filter("voltage filter", "the voltages", law.time_constant);
        break;
    }
  }
  void add_numbers(const ControlLaw& law) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto common = common_number(law, k, options_);
      if (common) {
        if (common->differs) add_number("all", k, common->found, common->model);
        continue;
      }
      for (const MuscleLaw& muscle : law.muscles) {
        if (muscle.differs(k, options_)) {
          add_number(muscle.name, k, muscle.found[k], muscle.model[k]);
        }
      }
    }
  }
  const std::vector<std::string>& words() const { return words_; }

 private:
  void add(const std::string& place, const std::string& law, const LawNumber& number,
           const std::string& unit) {
    const double half = options_.interval * number.sigma;
    MeasurementProperty property{
        "voltage", place,  "controller", number.value, {number.value - half, number.value + half},
        unit,      "found"};
    property.law = law;
    description_.measurement.push_back(std::move(property));
  }
  void on_error() {
    add("all", "derivative on error", {1.0, 0.0}, "1");
    words_.push_back("the derivative of the error, not of the measurement");
  }
  void filter(const std::string& law, const std::string& of, const LawNumber& time_constant) {
    add("all", law, time_constant, "s");
    words_.push_back("a first-order filter of " + significant(1000.0 * time_constant.value, 3) +
                     " ms on " + of);
  }
  void add_number(const std::string& place, std::size_t k, const LawNumber& found, double model) {
    add(place, kNumberNames[k], found, kNumberUnits[k]);
    words_.push_back((place == "all" ? "" : place + ": ") + kNumberNames[k] + " " +
                     significant(found.value, 3) + ", not " + significant(model, 3) + " " +
                     kNumberUnits[k]);
  }

  const ControllerAlgebraOptions& options_;
  Description& description_;
  std::vector<std::string> words_;
};

/// Whether a replay of positions is complete, and leaves anything to be compared.
bool can_feed_positions(const RobotModel& robot, const Dataset& recording) {
  bool is_compared = false;
  for (const MuscleModel& muscle : robot.muscles) {
    is_compared = is_compared || !recording.series(muscle.name + "/force").empty();
    if (recording.series(muscle.name + "/position").empty() &&
        !recording.series(muscle.name + "/reference").empty()) {
      return false;
    }
  }
  for (const JointModel& joint : robot.skeleton->joints) {
    const char* quantity = joint.type == JointType::kBall ? "/w" : "/position";
    is_compared = is_compared || !recording.series(joint.name + quantity).empty();
  }
  return is_compared;
}

/// From positions, if possible: voltages drive motors away, because their noise adds up.
/// @return what a remark says of it
std::string go_on_behind_controllers(const RobotModel& robot, Description& description) {
  const std::vector<Dataset*> recordings = recordings_of(description.question);
  const bool by_positions =
      std::all_of(recordings.begin(), recordings.end(),
                  [&](const Dataset* recording) { return can_feed_positions(robot, *recording); });
  description.question.feed = by_positions ? ReplayMode::kPosition : ReplayMode::kVoltage;
  description.corrected = true;
  return by_positions ? "The search goes on from the motors' positions, so nothing is said about "
                        "controllers and motors"
                      : "The search goes on from voltages, so nothing is said about controllers";
}

/// The entry of the model file at a key path: "joints.elbow.drive".
ConfigNode entry_at(const ConfigNode& config, const std::string& path) {
  ConfigNode node = config;
  std::istringstream keys(path);
  std::string key;
  while (std::getline(keys, key, '.')) node = node.at(key);
  return node;
}

/// Gains of the model file that are others, by key path; nothing if the model has no such law, or a
/// gain is not the same for all muscles, which share controllers.
std::optional<std::map<std::string, double>> gains_of(const RobotModel& robot,
                                                      const ConfigNode& config,
                                                      const ControlLaw& law,
                                                      const ControllerAlgebraOptions& options) {
  constexpr const char* kKeys[] = {"proportional", "derivative", "force_feedforward", ""};
  const bool leads = law.form == LawForm::kDerivativeOnError;
  if (law.form != LawForm::kModel && !leads) return {};
  std::map<std::string, double> gains;
  for (const MuscleLaw& muscle : law.muscles) {
    if (leads && !(muscle.used(MuscleLaw::kProportional, options) > 0.0)) return {};
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const auto common = common_number(law, k, options);
    if (!common) {
      const bool any =
          std::any_of(law.muscles.begin(), law.muscles.end(),
                      [&](const MuscleLaw& muscle) { return muscle.differs(k, options); });
      if (any) return {};
      continue;
    }
    if (!common->differs) continue;
    if (*kKeys[k] == '\0') return {};
    for (const MuscleLaw& muscle : law.muscles) {
      const ConfigNode node = entry_at(config, robot.muscles[robot.muscle_index(muscle.name)].key);
      if (node.has("gains")) return {};  // its own come before its controller's
      const std::string controller = node.text("controller");
      gains["controllers." + controller + ".position." + kKeys[k]] =
          std::max(0.0, common->found.value);
    }
  }
  return gains;
}

std::string go_on_with(const ControlLaw& law, const std::map<std::string, double>& gains,
                       const ControllerAlgebraOptions& options, Description& description) {
  for (Dataset* recording : recordings_of(description.question)) {
    recording->meta.model.insert(gains.begin(), gains.end());
    if (law.form != LawForm::kDerivativeOnError) continue;
    for (const MuscleLaw& muscle : law.muscles) {
      lead_reference(muscle.name,
                     muscle.used(MuscleLaw::kDerivative, options) /
                         muscle.used(MuscleLaw::kProportional, options),
                     law.tick, *recording);
    }
  }
  description.corrected = true;
  return "The search goes on with this law";
}

}  // namespace

std::optional<ControlLaw> other_law(const ControllerAlgebra& algebra,
                                    const std::optional<StampShift>& shift) {
  if (!algebra.is_known()) return {};
  const ControlledMuscles& data = algebra.data();
  const ControllerAlgebraOptions& options = data.options();
  if (algebra.left(shift) < options.least_law) return {};
  auto law = find_control_law(data);
  const double most = std::max(options.noise_only, options.unexplained.value * algebra.left({}));
  if (!law || data.left(law->squares) > most) return {};
  // What rounding to whole ticks leaves of a shift, some filter may fit.
  if (shift && algebra.left(shift) < options.rounded_shift * most) return {};
  if (data.sureness(algebra.squares_at({}), law->squares) < options.sure) return {};
  const auto explains = [&](const std::optional<StampShift>& other) {
    return other && data.sureness(algebra.squares_at(other), law->squares) < options.clearly;
  };
  if (explains(shift) || explains(algebra.latency())) return {};
  return law;
}

bool go_on_by_other_law(const RobotModel& robot, const ConfigNode& config, const ControlLaw& law,
                        Description& description) {
  const ControllerAlgebraOptions& options = description.question.options.measurement.controller;
  LawReport report(options, description);
  report.add_form(law);
  report.add_numbers(law);
  if (law.after_tick) {
    report_tick_phase(law.tick, law.tick / std::sqrt(12.0), description);
    for (Dataset* recording : recordings_of(description.question)) {
      move_earlier(robot, {"voltage"}, -law.tick, *recording);
    }
  }
  const auto gains = gains_of(robot, config, law, options);
  const std::string goes_on = gains ? go_on_with(law, *gains, options, description)
                                    : go_on_behind_controllers(robot, description);
  description.remarks.push_back("controller: the voltages follow another law than the model's: " +
                                joined(report.words(), "; ") + ". " + goes_on);
  return gains && gains->empty();
}

void remark_on_voltages(const ControllerAlgebra& algebra, const std::optional<StampShift>& shift,
                        Description& description) {
  const ControllerAlgebraOptions& options = description.question.options.measurement.controller;
  const double left = algebra.left(shift);
  if (left < options.other_law) return;
  const std::string differ =
      "under the model's control law, recorded references and measurements do not give the "
      "recorded voltages: they differ by " +
      significant(left, 2) + " times the noise of the voltages; ";
  const auto latency = algebra.latency();
  if (latency && algebra.left(latency) < options.other_law) {
    description.remarks.push_back(differ + "with " + kind_word(latency->what) +
                                  " that reach the controllers " +
                                  significant(-1000.0 * latency->late, 3) + " ms late, they do");
    return;
  }
  description.remarks.push_back(differ + "another law, other gains, or something that is late");
}

}  // namespace discovery
}  // namespace anthrob
