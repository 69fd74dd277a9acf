#pragma once

#include <Eigen/Core>

namespace anthrob {
namespace discovery {

/// Adds a small part of the largest diagonal element to the diagonal, so that unknowns on which
/// nothing depends have a solution.
void regularise(Eigen::MatrixXd& system);

/// Minimises 1/2 x' A x + g' x within bounds (projected active set).
Eigen::VectorXd bounded_minimum(const Eigen::MatrixXd& A, const Eigen::VectorXd& g,
                                const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

}  // namespace discovery
}  // namespace anthrob
