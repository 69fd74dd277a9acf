#include "identification/viscoelastic_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "anthrob_core/errors.h"
#include "identification/least_squares.h"

namespace anthrob {
namespace identification {

namespace {

/// Residuals closer together than this may be correlated: ten times the memory of the force
/// filter, and never less than [s]
constexpr double kBlock = 0.5;
constexpr double kFilterMemories = 10.0;

/// Forces of several tests against their recordings, while the strain is held.
class HoldProblem {
 public:
  /// @param fit_zero whether the zero of the expansion is a parameter, else it is 0
  HoldProblem(const RingRecording& recording, const std::vector<const RelaxationTest*>& tests,
              std::size_t arms, bool fit_zero)
      : arms_(arms), fit_zero_(fit_zero), tests_(tests) {
    int block = -1;
    for (const RelaxationTest* test : tests) {
      forces_.emplace_back(recording, *test);
      const auto length = static_cast<std::size_t>(std::ceil(
          std::max(kBlock / recording.period, kFilterMemories * recording.force_average)));
      const std::size_t count = test->t.size() - test->hold;
      for (std::size_t i = 0; i < count; ++i) {
        // What is left over at the end goes with the block before.
        if (i % length == 0 && (i == 0 || count - i >= length)) ++block;
        problem_.block.push_back(block);
      }
    }
    problem_.residual_count = problem_.block.size();
    problem_.evaluate = [this](const double* p, double* r, double* j) { evaluate(p, r, j); };
  }

  Fit solve_from(const ViscoelasticModel& start) {
    problem_.parameters = {{start.modulus, start.modulus, 1e-6 * start.modulus, HUGE_VAL}};
    for (const auto& arm : start.arms) {
      problem_.parameters.push_back({arm.modulus, arm.modulus, 1e-6 * arm.modulus, HUGE_VAL});
      problem_.parameters.push_back({arm.relaxation_time, arm.relaxation_time,
                                     1e-3 * arm.relaxation_time, 1e3 * arm.relaxation_time});
    }
    constexpr double kZeroScale = 1e-4;  // [m] a calliper's error
    if (fit_zero_) problem_.parameters.push_back({0.0, kZeroScale, -1.0, 1.0});
    return solve(problem_);
  }

 private:
  void evaluate(const double* parameters, double* residuals, double* jacobian) const {
    const std::size_t n = problem_.parameters.size();
    std::vector<double> p(parameters, parameters + n), force;
    p.resize(2 + 2 * arms_, 0.0);
    std::vector<std::vector<double>> derivatives(p.size());
    std::size_t row = 0;
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      forces_[k].evaluate(p.data(), arms_, force, jacobian ? &derivatives : nullptr);
      for (std::size_t i = tests_[k]->hold; i < force.size(); ++i, ++row) {
        residuals[row] = force[i] - tests_[k]->force[i];
        for (std::size_t c = 0; jacobian && c < n; ++c) jacobian[row * n + c] = derivatives[c][i];
      }
    }
  }

  std::size_t arms_;
  bool fit_zero_;
  std::vector<const RelaxationTest*> tests_;
  std::vector<RingForce> forces_;
  LeastSquares problem_;
};

/// Statics first: the settled stress gives E_0, what relaxed gives E_1.
ViscoelasticModel first_guess(const RingRecording& recording, const RelaxationTest& test) {
  const std::size_t size = test.t.size(), tenth = std::max<std::size_t>(1, (size - test.hold) / 10);
  const double per_strain = 1.0 / (recording.specimen.area() * test.strain);
  const double settled = mean(test.force, size - tenth, size) * per_strain;
  const double initial = mean(test.force, test.hold, test.hold + tenth) * per_strain;
  // At small strains noise may hide the relaxation; a tenth is typical of rubber.
  const double relaxed = std::max(initial - settled, 0.1 * std::abs(settled));
  return {std::max(settled, 1.0), {{relaxed, 1.0}}};
}

/// One relaxation time becomes a fast and a slow one.
ViscoelasticModel split_arm(const ViscoelasticModel& one) {
  const auto& arm = one.arms.front();
  return {one.modulus,
          {{0.7 * arm.modulus, 0.2 * arm.relaxation_time},
           {0.6 * arm.modulus, 2.0 * arm.relaxation_time}}};
}

/// Arms in the order of their relaxation times.
void sort_arms(Fit& fit, std::size_t arms) {
  if (arms != 2 || fit.values[2] <= fit.values[4]) return;
  std::vector<Eigen::Index> order(fit.values.size());
  std::iota(order.begin(), order.end(), 0);
  std::swap(order[1], order[3]);
  std::swap(order[2], order[4]);
  const Fit old = fit;
  if (old.at_bound) {
    const auto bound =
        std::find(order.begin(), order.end(), static_cast<Eigen::Index>(*old.at_bound));
    fit.at_bound = static_cast<std::size_t>(bound - order.begin());
  }
  for (std::size_t i = 0; i < order.size(); ++i) {
    fit.values[i] = old.values[static_cast<std::size_t>(order[i])];
    for (std::size_t k = 0; k < order.size(); ++k) {
      fit.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) =
          old.covariance(order[i], order[k]);
    }
  }
}

Fit fit_tests(const RingRecording& recording, const std::vector<const RelaxationTest*>& tests,
              std::size_t arms, bool fit_zero) {
  const ViscoelasticModel guess = first_guess(recording, *tests.back());
  Fit one = HoldProblem(recording, tests, 1, fit_zero).solve_from(guess);
  if (arms == 1) return one;
  const auto start = split_arm(ViscoelasticModel::from_parameters(one.values.data(), 1));
  Fit two = HoldProblem(recording, tests, 2, fit_zero).solve_from(start);
  sort_arms(two, arms);
  return two;
}

double r_squared(const ViscoelasticModel& model, const RingRecording& recording,
                 const RelaxationTest& test) {
  const double error = hold_error(model, 0.0, recording, test);
  const double middle = mean(test.force, test.hold, test.force.size());
  double squares = 0.0;
  for (std::size_t i = test.hold; i < test.force.size(); ++i) {
    squares += (test.force[i] - middle) * (test.force[i] - middle);
  }
  return 1.0 - error * error * static_cast<double>(test.force.size() - test.hold) / squares;
}

/// Strain and section enter every modulus as factors.
std::vector<Estimate> estimates_of(const Fit& fit, const RingRecording& recording,
                                   std::size_t count) {
  std::vector<Estimate> list;
  for (std::size_t i = 0; i < count; ++i) {
    const bool modulus = i == 0 || i % 2 == 1;
    const Estimate plain = fit.estimate(i);
    list.push_back(modulus ? widened(plain, recording.scale_sigma * plain.value) : plain);
  }
  return list;
}

/// Nothing where noise hides the relaxation at a strain that is not used anyway.
std::optional<LevelFit> fit_level(const RingRecording& recording, const RelaxationTest& test,
                                  std::size_t arms) {
  try {
    const Fit fit = fit_tests(recording, {&test}, arms, false);
    const auto model = ViscoelasticModel::from_parameters(fit.values.data(), arms);
    return LevelFit{test.strain, test.used, estimates_of(fit, recording, 1 + 2 * arms),
                    r_squared(model, recording, test)};
  } catch (const std::runtime_error&) {
    if (test.used) throw;
    return std::nullopt;
  }
}

}  // namespace

ViscoelasticModel ViscoelasticFit::model() const {
  std::vector<double> values;
  for (const Estimate& parameter : parameters) values.push_back(parameter.value);
  return ViscoelasticModel::from_parameters(values.data(), values.size() / 2);
}

bool ViscoelasticFit::shows_its_arms() const {
  return std::none_of(parameters.begin() + 1, parameters.end(),
                      [](const Estimate& p) { return p.sigma > 0.5 * std::abs(p.value); });
}

ViscoelasticFit fit_viscoelastic(const RingRecording& recording, std::size_t arms) {
  std::vector<const RelaxationTest*> used;
  ViscoelasticFit result;
  const std::size_t count = 1 + 2 * arms;
  try {
    std::vector<std::vector<double>> over_levels(count);
    for (const RelaxationTest& test : recording.tests) {
      const auto level = fit_level(recording, test, arms);
      if (level) result.levels.push_back(*level);
      if (!test.used) continue;
      used.push_back(&test);
      for (std::size_t i = 0; i < count; ++i) {
        over_levels[i].push_back(level->parameters[i].value);
      }
    }
    if (used.empty()) {
      throw BadInput(recording.name +
                     ": no test above strain 0.57, below which a ring bends into "
                     "an ellipse: expected one or more");
    }
    for (const auto& list : over_levels) result.over_levels.push_back(spread(list));
    const Fit fit = fit_tests(recording, used, arms, used.size() > 1);
    if (fit.at_bound) {
      auto names = parameter_names(arms);
      names.push_back("the zero of the expansion");
      throw std::runtime_error(names[*fit.at_bound] + " ends at the bound of the fit");
    }
    result.parameters = estimates_of(fit, recording, count);
    if (used.size() > 1) result.zero = fit.estimate(count);
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(recording.name + ": " + error.what());
  }
  return result;
}

}  // namespace identification
}  // namespace anthrob
