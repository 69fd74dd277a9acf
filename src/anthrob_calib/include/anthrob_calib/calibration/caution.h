#pragma once

#include <Eigen/Core>
#include <vector>

#include "anthrob_calib/calibration/difference_stack.h"

namespace anthrob {
namespace calibration {

/// Derivatives that hold as far as noise leaves a parameter open, not only at the point: where a
/// step to one side changes an instant much less than they promise, they become that little. A
/// tendon that is just taut at the best point tells a lot there, and nothing as soon as it is
/// slack.
/// @param left the stack's list at `best`   @param columns derivatives of the list by steps
void be_cautious(const std::vector<SearchVariable>& variables, const Point& best,
                 const std::vector<double>& left, const ResidualNoise& noise,
                 DifferenceStack& stack, std::vector<std::vector<double>>& columns);

/// The same along the line that leaves one parameter most room, the others following: a tendon's
/// length and its spindle together keep one posture and give up another one.
/// @param sigma of the parameter [steps]   @param direction of the line, by steps
/// @return whether anything was taken away
bool be_cautious_along(const std::vector<SearchVariable>& variables, const Point& best,
                       const std::vector<double>& left, const ResidualNoise& noise,
                       DifferenceStack& stack, double sigma, const Eigen::VectorXd& direction,
                       Eigen::MatrixXd& jacobian);

}  // namespace calibration
}  // namespace anthrob
