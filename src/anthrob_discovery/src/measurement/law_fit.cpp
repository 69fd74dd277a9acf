#include "measurement/law_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "measurement/low_pass.h"

namespace anthrob {
namespace discovery {

namespace {

using Numbers = Eigen::Vector4d;

/// Normal equations of rows.
struct NormalEquations {
  Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
  Numbers right = Numbers::Zero();
  Numbers noise = Numbers::Zero();  ///< that measurements add to the diagonal
  double squares = 0.0, rows = 0.0;

  void add(const Numbers& terms, const Numbers& variances, double voltage) {
    gram += terms * terms.transpose();
    right += voltage * terms;
    noise += variances;
    squares += voltage * voltage;
    rows += 1.0;
  }
  NormalEquations& operator+=(const NormalEquations& other) {
    gram += other.gram, right += other.right, noise += other.noise;
    squares += other.squares, rows += other.rows;
    return *this;
  }
  NormalEquations without(const NormalEquations& other) const {
    NormalEquations left = *this;
    left.gram -= other.gram, left.right -= other.right, left.noise -= other.noise;
    left.squares -= other.squares, left.rows -= other.rows;
    return left;
  }
  double noise_of(const Numbers& x) const { return x.cwiseAbs2().dot(noise); }
  double squares_of(const Numbers& x) const {
    return squares - 2.0 * x.dot(right) + x.dot(gram * x);
  }
  /// Nothing where noise is most of what a term has.
  std::optional<Numbers> solved(bool has_noise) const {
    Numbers scale = Numbers::Ones();
    for (int i = 0; i < 4; ++i) {
      if (gram(i, i) > 0.0) scale[i] = 1.0 / std::sqrt(gram(i, i));
    }
    Eigen::Matrix4d matrix = gram;
    if (has_noise) matrix.diagonal() -= noise;
    matrix = (scale.asDiagonal() * matrix * scale.asDiagonal()).eval();
    // A term that is never there keeps a gain of 0.
    for (int i = 0; i < 4; ++i) {
      if (!(gram(i, i) > 0.0)) matrix(i, i) = 1.0;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> eigen(matrix, Eigen::EigenvaluesOnly);
    if (eigen.eigenvalues()[0] < 1e-6) return {};
    return Numbers(scale.asDiagonal() * matrix.ldlt().solve(scale.asDiagonal() * right));
  }
};

/// The terms of a law in one recording of a muscle.
class LawTerms {
 public:
  LawTerms(const ControlledMuscle& muscle, LawForm form, double time_constant, double tick)
      : muscle_(muscle), form_(form), time_constant_(time_constant), tick_(tick) {
    if (form == LawForm::kModel || form == LawForm::kDerivativeOnError) return;
    velocity_.emplace(muscle.velocity, time_constant, BetweenRows::kLinear);
    if (form == LawForm::kFilteredDerivative) return;
    reference_.emplace(muscle.reference, time_constant, BetweenRows::kHeld);
    if (form != LawForm::kFilteredVoltage) return;
    position_.emplace(muscle.position, time_constant, BetweenRows::kLinear);
    if (!muscle.force.empty()) force_.emplace(muscle.force, time_constant, BetweenRows::kLinear);
  }

  /// @param time of the measurements that the controller had
  void at(double time, Numbers& terms, Numbers& variances) const {
    const Interpolated position = value(muscle_.position, position_, time),
                       velocity = value(muscle_.velocity, velocity_, time);
    const Interpolated force =
        muscle_.force.empty() ? Interpolated{0.0, 0.0} : value(muscle_.force, force_, time);
    const double reference = form_ == LawForm::kFilteredVoltage
                                 ? reference_->at(filtered_at(time))
                                 : muscle_.reference.held_at(time + 1e-9);
    terms << reference - position.value, rate(time, reference) - velocity.value, force.value, 1.0;
    variances << position.variance * muscle_.position_noise,
        velocity.variance * muscle_.velocity_noise, force.variance * muscle_.force_noise, 0.0;
  }
  /// Of the reference, as far as it enters [rad/s].
  double rate(double time, double reference) const {
    if (form_ == LawForm::kDerivativeOnError) {
      return (reference - muscle_.reference.held_at(time - tick_ + 1e-9)) / tick_;
    }
    if (form_ != LawForm::kFilteredDerivativeOnError) return 0.0;
    return (reference - reference_->at(filtered_at(time))) / time_constant_;
  }

 private:
  /// A filter that computes in ticks answers to the last one at once, this one only after it: half
  /// a tick on the mean.
  double filtered_at(double time) const { return time + 0.5 * tick_; }
  Interpolated value(const Series& series, const std::optional<LowPass>& filter,
                     double time) const {
    if (filter) return {filter->at(filtered_at(time)), filter->variance()};
    return interpolated(series, time);
  }

  const ControlledMuscle& muscle_;
  LawForm form_;
  double time_constant_, tick_;
  std::optional<LowPass> reference_, position_, velocity_, force_;
};

/// All recordings of one muscle.
struct PooledMuscle {
  std::vector<const ControlledMuscle*> recordings;
  std::map<std::size_t, NormalEquations> blocks;
  std::map<std::size_t, double> weights;  ///< of blocks [1/V^2]
  NormalEquations all;
};

std::array<double, 4> model_numbers(const ControlledMuscle& muscle) {
  return {muscle.gains.proportional, muscle.gains.derivative, muscle.gains.force_feedforward, 0.0};
}

/// By the jackknife over blocks.
void add_law_errors(const PooledMuscle& pooled, bool has_noise, MuscleLaw& law) {
  std::vector<Numbers> left;
  for (const auto& [block, own] : pooled.blocks) {
    if (const auto numbers = pooled.all.without(own).solved(has_noise)) left.push_back(*numbers);
  }
  if (left.size() < 2 || left.size() < pooled.blocks.size()) {
    law.is_determined = false;
    return;
  }
  const auto n = static_cast<double>(left.size());
  Numbers mean = Numbers::Zero(), square = Numbers::Zero();
  for (const Numbers& numbers : left) mean += numbers / n;
  for (const Numbers& numbers : left) square += (numbers - mean).cwiseAbs2();
  for (int i = 0; i < 4; ++i) {
    law.found[static_cast<std::size_t>(i)].sigma = std::sqrt(square[i] * (n - 1.0) / n);
  }
}

/// Root mean square of each term about its mean, in noise of the voltages.
void add_weights(const PooledMuscle& pooled, MuscleLaw& law) {
  const double noise = std::sqrt(pooled.recordings.front()->voltage_noise);
  for (int i = 0; i < 4; ++i) {
    const double mean = i == 3 ? 0.0 : pooled.all.gram(i, 3) / pooled.all.rows;
    const double square = pooled.all.gram(i, i) / pooled.all.rows - mean * mean;
    law.voltages[static_cast<std::size_t>(i)] = std::sqrt(std::max(0.0, square)) / noise;
  }
}

/// @param squares to which what is left is added
MuscleLaw fit_muscle(const std::string& name, const PooledMuscle& pooled, Squares& squares) {
  MuscleLaw law;
  law.name = name;
  law.model = model_numbers(*pooled.recordings.front());
  const Numbers model(law.model.data());
  auto solved = pooled.all.solved(false);
  // Where the recorded measurements are those that the controller had, their noise is in both.
  const bool is_shared =
      solved && pooled.all.squares_of(*solved) < 0.5 * pooled.all.noise_of(*solved);
  if (!is_shared) solved = pooled.all.solved(true);
  // Gains may grow until the noise of the measurements explains whatever is left.
  law.is_determined = solved && pooled.all.squares_of(*solved) < pooled.all.squares_of(model);
  if (law.is_determined) add_law_errors(pooled, !is_shared, law);
  const Numbers numbers = law.is_determined ? *solved : model;
  for (std::size_t i = 0; i < 4; ++i) law.found[i].value = numbers[static_cast<int>(i)];
  add_weights(pooled, law);
  for (const auto& [block, own] : pooled.blocks) {
    squares[block] += pooled.weights.at(block) *
                      (own.squares_of(numbers) - (is_shared ? 0.0 : own.noise_of(numbers)));
  }
  return law;
}

}  // namespace

ControlLaw fit_law(const ControlledMuscles& data, LawForm form, double time_constant,
                   bool after_tick) {
  std::vector<std::string> names;
  std::map<std::string, PooledMuscle> muscles;
  for (const ControlledMuscle& muscle : data.muscles()) {
    PooledMuscle& pooled = muscles[muscle.name];
    if (pooled.recordings.empty()) names.push_back(muscle.name);
    pooled.recordings.push_back(&muscle);
    const LawTerms law(muscle, form, time_constant, data.tick());
    for (const std::size_t row : muscle.rows) {
      const double time = muscle.voltage.t[row] - (after_tick ? 0.0 : data.tick());
      Numbers terms, variances;
      law.at(time, terms, variances);
      const std::size_t block = muscle.block_of(row, data.options().block);
      pooled.blocks[block].add(terms, variances, muscle.voltage.values[row]);
      pooled.weights[block] = muscle.weight;
    }
  }
  ControlLaw law;
  law.form = form;
  law.time_constant.value = time_constant;
  law.tick = data.tick();
  law.after_tick = after_tick;
  law.squares.assign(data.blocks(), 0.0);
  for (const std::string& name : names) {
    PooledMuscle& pooled = muscles[name];
    for (const auto& [block, own] : pooled.blocks) pooled.all += own;
    law.muscles.push_back(fit_muscle(name, pooled, law.squares));
  }
  return law;
}

}  // namespace discovery
}  // namespace anthrob
