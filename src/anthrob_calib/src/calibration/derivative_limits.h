#pragma once

#include <Eigen/Core>
#include <vector>

#include "problem/difference_stack.h"

namespace anthrob {
namespace calibration {

/// Reduces derivatives to what holds for steps as large as the noise leaves the parameter
/// uncertain, not only at the best point. Where a step to either side changes an instant much less
/// than its derivative predicts, the derivative is replaced by the difference quotient of that
/// step. Example: a tendon that is just taut at the best point has large derivatives there, and
/// none as soon as it is slack.
/// @param left the stack's list at `best`
/// @param columns derivatives of the list with respect to each parameter, in steps; changed
void limit_derivatives(const std::vector<SearchVariable>& variables, const Point& best,
                       const std::vector<double>& left, const ResidualNoise& noise,
                       DifferenceStack& stack, std::vector<std::vector<double>>& columns);

/// The same for steps along a direction in which one parameter changes and the others compensate
/// for it as well as they can. Example: a tendon's length and its spindle radius can change
/// together so that one posture stays the same, but not another one.
/// @param sigma standard error of the parameter [steps]   @param direction in steps
/// @param jacobian derivatives in steps; changed
/// @return whether any derivative was reduced
bool limit_derivatives_along(const std::vector<SearchVariable>& variables, const Point& best,
                             const std::vector<double>& left, const ResidualNoise& noise,
                             DifferenceStack& stack, double sigma, const Eigen::VectorXd& direction,
                             Eigen::MatrixXd& jacobian);

}  // namespace calibration
}  // namespace anthrob
