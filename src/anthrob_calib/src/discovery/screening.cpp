#include "anthrob_calib/discovery/screening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace anthrob {
namespace discovery {

namespace {

/// Unknowns that can still move.
std::vector<Eigen::Index> free_unknowns(const Fitted& base) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < base.unknowns.size(); ++i) {
    const Unknown& u = base.unknowns[i];
    const double value = u.read(base.variant), margin = 1e-3 * u.scale;
    if (value > u.lower + margin && value < u.upper - margin) {
      free.push_back(static_cast<Eigen::Index>(i));
    }
  }
  return free;
}

Eigen::MatrixXf columns_of(const Eigen::MatrixXf& matrix, const std::vector<Eigen::Index>& which) {
  Eigen::MatrixXf part(matrix.rows(), static_cast<Eigen::Index>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i) {
    part.col(static_cast<Eigen::Index>(i)) = matrix.col(which[i]);
  }
  return part;
}

}  // namespace

Screening::Screening(const ModelFit& fit, const Fitted& base,
                     const std::vector<Candidate>& candidates)
    : fit_(fit.first_recordings(kEnough)), candidates_(candidates) {
  std::vector<std::size_t> all;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    first_column_.push_back(columns_.size());
    for (const EffectParameter* size : candidates[c].sizes()) {
      const double dose = size->typical - size->neutral;
      double lower = (size->bounds.lo - size->neutral) / dose;
      double upper = (size->bounds.hi - size->neutral) / dose;
      if (dose < 0.0) std::swap(lower, upper);
      all.push_back(columns_.size());
      columns_.push_back({c, size, lower, upper, false});
    }
  }
  first_column_.push_back(columns_.size());
  responses_.setZero(fit_.whitening().size(), static_cast<Eigen::Index>(columns_.size()));
  simulate(base, all);
}

void Screening::simulate(const Fitted& base, const std::vector<std::size_t>& columns) {
  std::vector<Variant> doses;
  for (const std::size_t i : columns) {
    Variant variant = base.variant;
    variant.effects.push_back(candidates_[columns_[i].candidate].dose(*columns_[i].size));
    doses.push_back(std::move(variant));
  }
  const auto results = fit_.residuals(doses);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    Column& column = columns_[columns[k]];
    column.simulated = results[k].size() > 0;
    auto response = responses_.col(static_cast<Eigen::Index>(columns[k]));
    if (column.simulated) {
      response = results[k] - base.residual.head(responses_.rows());
    } else {
      response.setZero();
    }
  }
}

void Screening::renew(const Fitted& base, const std::vector<Score>& best, std::size_t count) {
  std::vector<std::size_t> columns;
  for (std::size_t s = 0; s < best.size() && s < count; ++s) {
    const std::size_t c = best[s].candidate;
    for (std::size_t i = first_column_[c]; i < first_column_[c + 1]; ++i) columns.push_back(i);
  }
  simulate(base, columns);
}

void Screening::project(const Fitted& base) {
  free_ = free_unknowns(base);
  const Eigen::MatrixXf J = columns_of(base.sensitivity.topRows(responses_.rows()), free_);
  Eigen::MatrixXd A = (J.transpose() * J).cast<double>();
  const Eigen::VectorXd precision = base.precision();
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    A(k, k) += precision[free_[i]] + 1e-9 * (1.0 + A(k, k));
  }
  const Eigen::MatrixXd JS = (J.transpose() * responses_).cast<double>();
  absorbed_ =
      free_.empty() ? Eigen::MatrixXd::Zero(0, JS.cols()).eval() : A.ldlt().solve(JS).eval();
  gram_ = (responses_.transpose() * responses_).cast<double>();
  if (!free_.empty()) gram_ -= JS.transpose() * absorbed_;
}

std::vector<Score> Screening::scores(const Fitted& base) {
  project(base);
  const Eigen::MatrixXf J = columns_of(base.sensitivity.topRows(responses_.rows()), free_);
  const Eigen::VectorXf residual = base.residual.head(responses_.rows());
  const Eigen::VectorXd precision = base.precision(), off = base.scaled() - base.expected();
  Eigen::VectorXd pull = (J.transpose() * residual).cast<double>();
  for (std::size_t i = 0; i < free_.size(); ++i) {
    pull[static_cast<Eigen::Index>(i)] += precision[free_[i]] * off[free_[i]];
  }
  Eigen::VectorXd gradient = (responses_.transpose() * residual).cast<double>();
  if (!free_.empty()) gradient -= absorbed_.transpose() * pull;

  std::vector<Score> scores;
  for (std::size_t c = 0; c < candidates_.size(); ++c) {
    Score score;
    score.candidate = c;
    score.uncertainty = std::numeric_limits<double>::infinity();
    const auto from = static_cast<Eigen::Index>(first_column_[c]);
    const auto count = static_cast<Eigen::Index>(first_column_[c + 1]) - from;
    Eigen::MatrixXd A = gram_.block(from, from, count, count);
    const Eigen::VectorXd g = gradient.segment(from, count);
    Eigen::VectorXd lower(count), upper(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Column& column = columns_[static_cast<std::size_t>(from + i)];
      const double own = responses_.col(from + i).squaredNorm();
      // Less than a thousandth left: the ordinary parameters do the same.
      const bool visible = column.simulated && A(i, i) > 1e-4 * own && A(i, i) > 1e-6;
      lower[i] = visible ? std::max(column.lower, -100.0) : 0.0;
      upper[i] = visible ? std::min(column.upper, 100.0) : 0.0;
      if (i == 0 && visible) score.uncertainty = 1.0 / std::sqrt(A(i, i));
      if (!visible) A(i, i) += 1.0;
    }
    A.diagonal() *= 1.0 + 1e-6;
    const Eigen::VectorXd amount = bounded_minimum(A, g, lower, upper);
    score.gain = -(0.5 * amount.dot(A * amount) + g.dot(amount));
    score.amount.assign(amount.data(), amount.data() + count);
    scores.push_back(std::move(score));
  }
  std::stable_sort(scores.begin(), scores.end(),
                   [](const Score& a, const Score& b) { return a.gain > b.gain; });
  return scores;
}

}  // namespace discovery
}  // namespace anthrob
