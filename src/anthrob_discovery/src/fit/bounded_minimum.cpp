#include "fit/bounded_minimum.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <vector>

namespace anthrob {
namespace discovery {

void regularise(Eigen::MatrixXd& system) {
  if (system.rows() == 0) return;
  system.diagonal().array() += 1e-9 * (1.0 + system.diagonal().maxCoeff());
}

Eigen::VectorXd bounded_minimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& g,
                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::Index n = g.size();
  if (n == 0) return g;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(n).cwiseMax(lower).cwiseMin(upper);
  std::vector<char> held(static_cast<std::size_t>(n), 0);
  for (int sweep = 0; sweep < 50; ++sweep) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!held[static_cast<std::size_t>(i)]) free.push_back(i);
    }
    const auto m = static_cast<Eigen::Index>(free.size());
    Eigen::MatrixXd system(m, m);
    Eigen::VectorXd rhs(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = free[static_cast<std::size_t>(i)];
      rhs[i] = -g[r];
      for (Eigen::Index j = 0; j < n; ++j) {
        if (held[static_cast<std::size_t>(j)]) rhs[i] -= A(r, j) * x[j];
      }
      for (Eigen::Index j = 0; j < m; ++j) {
        system(i, j) = A(r, free[static_cast<std::size_t>(j)]);
      }
    }
    const Eigen::VectorXd solution = m > 0 ? system.ldlt().solve(rhs).eval() : Eigen::VectorXd();
    bool changed = false;
    for (Eigen::Index i = 0; i < m; ++i) {
      const Eigen::Index r = free[static_cast<std::size_t>(i)];
      x[r] = std::clamp(solution[i], lower[r], upper[r]);
      if (x[r] != solution[i]) {
        held[static_cast<std::size_t>(r)] = 1;
        changed = true;
      }
    }
    if (changed) continue;
    // Frees the one whose gradient points inwards most.
    const Eigen::VectorXd gradient = A * x + g;
    Eigen::Index best = -1;
    double strongest = 1e-9 * (1.0 + g.cwiseAbs().maxCoeff());
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!held[static_cast<std::size_t>(i)] || lower[i] == upper[i]) continue;
      const double inwards = x[i] <= lower[i] ? -gradient[i] : gradient[i];
      if (inwards > strongest) {
        strongest = inwards;
        best = i;
      }
    }
    if (best < 0) break;
    held[static_cast<std::size_t>(best)] = 0;
  }
  return x;
}

}  // namespace discovery
}  // namespace anthrob
