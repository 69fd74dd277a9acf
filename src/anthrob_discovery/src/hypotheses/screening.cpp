#include "hypotheses/screening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "fit/bounded_minimum.h"

namespace anthrob {
namespace discovery {

namespace {

/// Unknowns that can still move.
std::vector<Eigen::Index> free_unknowns(const Fitted& base, const FitOptions& options) {
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < base.unknowns.size(); ++i) {
    if (!base.at_bound(i, options.convergence.at_bound))
      free.push_back(static_cast<Eigen::Index>(i));
  }
  return free;
}

std::vector<Eigen::Index> all_unknowns(const Fitted& base) {
  std::vector<Eigen::Index> all(base.unknowns.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

Screening::Screening(const ModelFit& fit, const Fitted& base,
                     const std::vector<Candidate>& candidates, const Excerpt& quick,
                     const Excerpt& slow, const ScreeningOptions& options)
    : candidates_(candidates), options_(options) {
  std::vector<std::size_t> few, many;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    (candidates[c].effect->info().slow ? few : many).push_back(c);
  }
  if (!many.empty()) {
    add_look(fit, base, quick, std::move(many));
    // An effect without influence in these seconds may act later.
    if (slow.rows.size() > quick.rows.size()) {
      const std::vector<std::size_t> faint = take_faint(looks_.back());
      few.insert(few.end(), faint.begin(), faint.end());
    }
  }
  if (!few.empty()) add_look(fit, base, slow, std::move(few));
}

std::optional<std::size_t> Screening::Look::index_of(std::size_t candidate) const {
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    if (candidates[k] == candidate && !moved[k]) return k;
  }
  return std::nullopt;
}

std::vector<std::size_t> Screening::take_faint(Look& look) const {
  std::vector<std::size_t> faint;
  for (std::size_t k = 0; k < look.candidates.size(); ++k) {
    const auto from = static_cast<Eigen::Index>(look.first_column[k]);
    const auto count = static_cast<Eigen::Index>(look.first_column[k + 1]) - from;
    if (look.responses.middleCols(from, count).squaredNorm() > options_.faint) continue;
    faint.push_back(look.candidates[k]);
    look.moved[k] = 1;
  }
  return faint;
}

void Screening::add_look(const ModelFit& fit, const Fitted& base, const Excerpt& excerpt,
                         std::vector<std::size_t> candidates) {
  Look look{fit.part(excerpt), excerpt, std::move(candidates), {}, {}, {}, {}};
  look.moved.assign(look.candidates.size(), 0);
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < look.candidates.size(); ++k) {
    look.first_column.push_back(look.columns.size());
    for (const EffectParameter* size : candidates_[look.candidates[k]].sizes()) {
      const double dose = size->typical - size->neutral;
      double lower = (size->bounds.lo - size->neutral) / dose;
      double upper = (size->bounds.hi - size->neutral) / dose;
      if (dose < 0.0) std::swap(lower, upper);
      look.columns.push_back({size, lower, upper, false});
    }
    all.push_back(k);
  }
  look.first_column.push_back(look.columns.size());
  look.responses.setZero(static_cast<Eigen::Index>(excerpt.rows.size()),
                         static_cast<Eigen::Index>(look.columns.size()));
  simulate(look, base, all);
  looks_.push_back(std::move(look));
}

void Screening::simulate(Look& look, const Fitted& base, const std::vector<std::size_t>& which) {
  std::vector<Variant> doses;
  std::vector<std::size_t> columns;
  for (const std::size_t k : which) {
    if (look.moved[k]) continue;
    for (std::size_t i = look.first_column[k]; i < look.first_column[k + 1]; ++i) {
      Variant variant = base.variant;
      variant.effects.push_back(candidates_[look.candidates[k]].dose(*look.columns[i].size));
      doses.push_back(std::move(variant));
      columns.push_back(i);
    }
  }
  const auto changes = look.fit.changes(base.variant, look.excerpt.of(base.residual), doses);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    look.columns[columns[k]].simulated = changes[k].size() > 0;
    auto response = look.responses.col(static_cast<Eigen::Index>(columns[k]));
    if (changes[k].size() > 0) {
      response = changes[k];
    } else {
      response.setZero();
    }
  }
  take_both_sides(look, base, which);
}

void Screening::take_both_sides(Look& look, const Fitted& base,
                                const std::vector<std::size_t>& which) {
  const Projection p = project_whole(look, base);
  std::vector<Variant> doses;
  std::vector<std::size_t> columns;
  for (const std::size_t k : which) {
    if (look.moved[k]) continue;
    for (std::size_t i = look.first_column[k]; i < look.first_column[k + 1]; ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      const double whole = look.responses.col(c).cast<double>().squaredNorm();
      const bool imitated = whole > options_.faint && p.left(c, whole) < options_.imitated * whole;
      if (!imitated || look.columns[i].lower > -1.0) continue;
      std::vector<double> amount(look.first_column[k + 1] - look.first_column[k], 0.0);
      amount[i - look.first_column[k]] = -1.0;
      Variant variant = base.variant;
      variant.effects.push_back(candidates_[look.candidates[k]].sized(amount));
      doses.push_back(std::move(variant));
      columns.push_back(i);
    }
  }
  if (doses.empty()) return;
  const auto changes = look.fit.changes(base.variant, look.excerpt.of(base.residual), doses);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (changes[k].size() == 0) continue;
    auto response = look.responses.col(static_cast<Eigen::Index>(columns[k]));
    response = 0.5f * (response - changes[k]);
  }
}

void Screening::renew(const Fitted& base, const std::vector<Score>& best, std::size_t count) {
  for (Look& look : looks_) {
    std::vector<std::size_t> which;
    for (std::size_t s = 0; s < best.size() && s < count; ++s) {
      if (const auto k = look.index_of(best[s].candidate)) which.push_back(*k);
    }
    if (!which.empty()) simulate(look, base, which);
  }
}

Screening::Projection Screening::project(const Look& look, const Fitted& base,
                                         const std::vector<Eigen::Index>& unknowns,
                                         double share) const {
  Projection p;
  p.J = look.excerpt.of(base.sensitivity, unknowns);
  const Eigen::MatrixXf& J = p.J;
  const Eigen::VectorXf residual = look.excerpt.of(base.residual);
  const Eigen::VectorXd precision = share * base.precision();
  const Eigen::VectorXd off = base.scaled() - base.expected();
  Eigen::MatrixXd A = (J.transpose() * J).cast<double>();
  Eigen::VectorXd pull = (J.transpose() * residual).cast<double>();
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    A(k, k) += precision[unknowns[i]] + 1e-9 * (1.0 + A(k, k));
    pull[k] += precision[unknowns[i]] * off[unknowns[i]];
  }
  p.precision = precision(unknowns);
  p.covariance = A.ldlt().solve(Eigen::MatrixXd::Identity(A.rows(), A.rows()));
  p.JS = (J.transpose() * look.responses).cast<double>();
  p.absorbed = p.covariance * p.JS;
  p.gradient =
      (look.responses.transpose() * residual).cast<double>() - p.absorbed.transpose() * pull;
  return p;
}

double Screening::share_of_whole(const Look& look, const Fitted& base) {
  return static_cast<double>(look.excerpt.rows.size()) / static_cast<double>(base.residual.size());
}

Screening::Projection Screening::project_whole(const Look& look, const Fitted& base) const {
  Projection p = project(look, base, all_unknowns(base), share_of_whole(look, base));
  for (std::size_t k = 0; k < look.candidates.size(); ++k) {
    if (look.moved[k]) continue;
    for (const int nuisance : candidates_[look.candidates[k]].same_as) {
      for (std::size_t i = 0; i < base.unknowns.size(); ++i) {
        if (base.unknowns[i].nuisance != nuisance) continue;
        for (std::size_t c = look.first_column[k]; c < look.first_column[k + 1]; ++c) {
          p.hold(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(c));
        }
      }
    }
  }
  return p;
}

double Screening::Projection::left(Eigen::Index response, double whole) const {
  // JS'a = a'J'J a + a'P a; the prior term a'P a shows in no recording.
  return whole - JS.col(response).dot(absorbed.col(response)) -
         absorbed.col(response).cwiseAbs2().dot(precision);
}

void Screening::Projection::hold(Eigen::Index unknown, Eigen::Index response) {
  absorbed.col(response) -=
      covariance.col(unknown) * (absorbed(unknown, response) / covariance(unknown, unknown));
}

void Screening::score(const Look& look, const Fitted& base, std::vector<Score>& scores) const {
  const Projection p = project(look, base, free_unknowns(base, look.fit.options()), 1.0),
                   in_all = project_whole(look, base);
  for (std::size_t k = 0; k < look.candidates.size(); ++k) {
    if (look.moved[k]) continue;
    Score score;
    score.candidate = look.candidates[k];
    score.seconds = look.excerpt.duration();
    score.uncertainty = std::numeric_limits<double>::infinity();
    const auto from = static_cast<Eigen::Index>(look.first_column[k]);
    const auto count = static_cast<Eigen::Index>(look.first_column[k + 1]) - from;
    const auto own = look.responses.middleCols(from, count);
    Eigen::MatrixXd h = (own.transpose() * own).cast<double>();
    const Eigen::VectorXd whole = h.diagonal();
    h -= p.JS.middleCols(from, count).transpose() * p.absorbed.middleCols(from, count);
    const Eigen::VectorXd g = p.gradient.segment(from, count);
    Eigen::VectorXd lower(count), upper(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Column& column = look.columns[static_cast<std::size_t>(from + i)];
      // Where hardly anything of the change is left, ordinary parameters can do the same.
      const auto shows_in = [&](double left) {
        return column.simulated && left > options_.visible * whole[i] &&
               left > options_.least_square;
      };
      const bool visible = shows_in(h(i, i));
      lower[i] = visible ? std::max(column.lower, -options_.largest) : 0.0;
      upper[i] = visible ? std::min(column.upper, options_.largest) : 0.0;
      const double left = in_all.left(from + i, whole[i]);
      if (shows_in(left) && 1.0 / std::sqrt(left) < score.uncertainty) {
        score.uncertainty = 1.0 / std::sqrt(left);
        score.size = static_cast<std::size_t>(i);
      }
      if (!visible) h(i, i) += 1.0;
    }
    h.diagonal() *= 1.0 + 1e-6;
    const Eigen::VectorXd amount = bounded_minimum(h, g, lower, upper);
    score.gain = -(0.5 * amount.dot(h * amount) + g.dot(amount));
    score.amount.assign(amount.data(), amount.data() + count);
    scores.push_back(std::move(score));
  }
}

std::vector<double> Screening::doses_to_a_gap(const Fitted& base, const std::vector<Score>& scores,
                                              const Judge& judge,
                                              const std::map<std::string, double>& levels) const {
  std::vector<double> doses(scores.size(), std::numeric_limits<double>::infinity());
  const std::map<std::string, double> now = judge.channel_gaps(base.residual);
  Eigen::VectorXf whole = Eigen::VectorXf::Zero(base.residual.size());
  for (const Look& look : looks_) {
    const Projection p = project_whole(look, base);
    Eigen::MatrixXf left = look.responses;
    if (p.J.cols() > 0) left -= p.J * p.absorbed.cast<float>();
    const double share = share_of_whole(look, base);
    whole.setZero();
    for (std::size_t s = 0; s < scores.size(); ++s) {
      const auto k = look.index_of(scores[s].candidate);
      if (!k) continue;
      whole(look.excerpt.rows) =
          left.col(static_cast<Eigen::Index>(look.first_column[*k] + scores[s].size));
      for (const auto& [name, change] : judge.channel_gaps(whole)) {
        // The gap that is there now may be due to the effect itself.
        const double floor = std::min(1.0, now.at(name));
        const auto level = levels.find(name);
        if (level == levels.end() || change <= 0.0) continue;
        const double missing = std::sqrt(level->second * level->second - floor * floor);
        doses[s] = std::min(doses[s], missing * std::sqrt(share) / change);
      }
    }
  }
  return doses;
}

std::vector<std::vector<std::size_t>> Screening::alike(const Fitted& base) const {
  std::vector<std::vector<std::size_t>> groups;
  for (const Look& look : looks_) {
    const Projection p = project(look, base, all_unknowns(base), share_of_whole(look, base));
    Eigen::MatrixXd gram = (look.responses.transpose() * look.responses).cast<double>();
    const Eigen::VectorXd whole = gram.diagonal();
    gram -= p.JS.transpose() * p.absorbed;
    std::vector<std::pair<std::size_t, Eigen::Index>> leaders;  // group, column
    const std::size_t first = groups.size();
    for (std::size_t k = 0; k < look.candidates.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(look.first_column[k]);
      const bool alone = look.first_column[k + 1] - look.first_column[k] == 1;
      // An effect of several sizes has more than one shape of response.
      if (look.moved[k] || !alone || !(gram(i, i) > options_.faint) ||
          gram(i, i) < options_.visible * whole[i]) {
        continue;
      }
      const auto leader = std::find_if(leaders.begin(), leaders.end(), [&](const auto& other) {
        const Eigen::Index o = other.second;
        return std::abs(gram(i, o)) > options_.alike * std::sqrt(gram(i, i) * gram(o, o));
      });
      if (leader == leaders.end()) {
        leaders.emplace_back(groups.size(), i);
        groups.push_back({look.candidates[k]});
      } else {
        groups[leader->first].push_back(look.candidates[k]);
      }
    }
    groups.erase(std::remove_if(groups.begin() + static_cast<std::ptrdiff_t>(first), groups.end(),
                                [](const auto& group) { return group.size() < 2; }),
                 groups.end());
  }
  return groups;
}

std::vector<Score> Screening::scores(const Fitted& base) const {
  std::vector<Score> scores;
  for (const Look& look : looks_) score(look, base, scores);
  double shortest = std::numeric_limits<double>::infinity();
  for (const Score& s : scores) shortest = std::min(shortest, s.seconds);
  for (Score& s : scores) s.gain *= shortest / s.seconds;
  std::stable_sort(scores.begin(), scores.end(),
                   [](const Score& a, const Score& b) { return a.gain > b.gain; });
  return scores;
}

}  // namespace discovery
}  // namespace anthrob
