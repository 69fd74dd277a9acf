#pragma once

#include <string>
#include <vector>

namespace anthrob {
namespace calibration {

using Point = std::vector<double>;

/// A variable of the search.
struct SearchVariable {
  double initial = 0.0;
  double lower = 0.0, upper = 0.0;
  double step = 1.0;  ///< size of an ordinary change, > 0
};

/// Evaluates points for an optimiser. The results depend on the points only: they are the same to
/// the last bit on any number of threads or hosts.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  /// The function to minimise; infinite for an invalid point.
  virtual std::vector<double> fitness(const std::vector<Point>& points) = 0;
  /// Numbers whose squares add up to the fitness; an empty list for an invalid point.
  virtual std::vector<std::vector<double>> residuals(const std::vector<Point>& points) = 0;
};

}  // namespace calibration
}  // namespace anthrob
