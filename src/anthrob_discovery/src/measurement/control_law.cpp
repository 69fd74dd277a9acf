#include "measurement/control_law.h"

#include <algorithm>
#include <cmath>

#include "measurement/law_fit.h"

namespace anthrob {
namespace discovery {

namespace {

bool is_filtered(LawForm form) {
  return form == LawForm::kFilteredDerivative || form == LawForm::kFilteredDerivativeOnError ||
         form == LawForm::kFilteredVoltage;
}

/// How much a law says beyond gains.
int complexity(const ControlLaw& law) {
  if (law.form == LawForm::kModel) return 0;
  return law.form == LawForm::kFilteredDerivativeOnError ? 2 : 1;
}

/// The vertex of a parabola through squares at -1, 0 and 1; within these.
double vertex(double before, double at, double after) {
  const double bend = before - 2.0 * at + after;
  return bend > 0.0 ? std::clamp(0.5 * (before - after) / bend, -1.0, 1.0) : 0.0;
}

/// Of the logarithm of a time constant, from the two neighbours of the best one.
void refine_time_constant(const ControlledMuscles& data, double ratio, ControlLaw& law) {
  const double middle = law.time_constant.value;
  const auto at = [&](double factor) {
    return fit_law(data, law.form, middle * factor, law.after_tick).squares;
  };
  const Squares before = at(1.0 / ratio), after = at(ratio);
  const double a = sum_of(before), b = sum_of(law.squares), c = sum_of(after);
  const double whole = vertex(a, b, c);
  double square = 0.0;
  const auto n = static_cast<double>(data.blocks());
  for (std::size_t i = 0; i < data.blocks(); ++i) {
    square += std::pow(vertex(a - before[i], b - law.squares[i], c - after[i]) - whole, 2);
  }
  const double step = std::log(ratio);
  law = fit_law(data, law.form, middle * std::exp(whole * step), law.after_tick);
  law.time_constant.sigma = law.time_constant.value * step * std::sqrt(square * (n - 1.0) / n);
}

/// The best of a form, before the tick or after it.
ControlLaw best_law(const ControlledMuscles& data, LawForm form, bool after_tick) {
  const ControllerAlgebraOptions& options = data.options();
  if (!is_filtered(form)) return fit_law(data, form, 0.0, after_tick);
  std::optional<ControlLaw> best;
  const auto improve = [&](double time_constant) {
    ControlLaw law = fit_law(data, form, time_constant, after_tick);
    if (!best || sum_of(law.squares) < sum_of(best->squares)) best = std::move(law);
  };
  double ratio = 2.0;
  const double shortest = options.shortest_filter * data.tick();
  for (double tau = shortest; tau <= options.longest_filter; tau *= ratio) improve(tau);
  while (ratio > options.filter_step) {
    ratio = std::sqrt(ratio);
    const double middle = best->time_constant.value;
    improve(middle * ratio);
    if (middle > shortest) improve(middle / ratio);
  }
  refine_time_constant(data, ratio, *best);
  return *best;
}

bool has_other_gains(const ControlLaw& law, const ControllerAlgebraOptions& options) {
  return std::any_of(law.muscles.begin(), law.muscles.end(), [&](const MuscleLaw& muscle) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (muscle.differs(i, options)) return true;
    }
    return false;
  });
}

}  // namespace

bool MuscleLaw::differs(std::size_t number, const ControllerAlgebraOptions& options) const {
  const double by = std::abs(found[number].value - model[number]);
  return is_determined && by > options.sure * found[number].sigma &&
         by > options.least_gain.value * std::abs(model[number]) &&
         by * voltages[number] > options.least_law;
}

std::optional<ControlLaw> find_control_law(const ControlledMuscles& data) {
  if (!data.is_known()) return {};
  const ControllerAlgebraOptions& options = data.options();
  std::vector<ControlLaw> laws;
  for (const LawForm form :
       {LawForm::kModel, LawForm::kDerivativeOnError, LawForm::kFilteredDerivative,
        LawForm::kFilteredVoltage, LawForm::kFilteredDerivativeOnError}) {
    const ControlLaw before = best_law(data, form, false), after = best_law(data, form, true);
    const bool is_after = data.sureness(before.squares, after.squares) > options.clearly;
    laws.push_back(is_after ? after : before);
  }
  const auto less = [](const ControlLaw& a, const ControlLaw& b) {
    return sum_of(a.squares) < sum_of(b.squares);
  };
  const ControlLaw& best = *std::min_element(laws.begin(), laws.end(), less);
  // The simplest that the voltages do not show to be worse. Interpolated rows are not exact,
  // either.
  const auto is_worse = [&](const ControlLaw& law) {
    const double own = data.left(law.squares), least = data.left(best.squares);
    return own * own - least * least > options.least_law * options.least_law &&
           own > (1.0 + options.least_law) * least &&
           data.sureness(law.squares, best.squares) > options.clearly;
  };
  const ControlLaw* simplest = &best;
  for (const ControlLaw& law : laws) {
    if (complexity(law) < complexity(*simplest) && !is_worse(law)) simplest = &law;
  }
  if (simplest->form == LawForm::kModel && !has_other_gains(*simplest, options)) return {};
  return *simplest;
}

}  // namespace discovery
}  // namespace anthrob
