#pragma once

#include <string>
#include <vector>

namespace anthrob {
namespace calibration {

using Point = std::vector<double>;

/// A number to search for.
struct SearchVariable {
  double initial = 0.0;
  double lower = 0.0, upper = 0.0;
  double step = 1.0;  ///< size of an ordinary change, > 0
};

/// Where an optimiser asks how good points are. A function of the points alone: whoever evaluates
/// them, on how many threads or hosts, the numbers are the same to the last bit.
class Evaluator {
 public:
  virtual ~Evaluator() = default;
  /// To be made small; infinite for an invalid point.
  virtual std::vector<double> fitness(const std::vector<Point>& points) = 0;
  /// Numbers whose squares add up to the fitness; an empty list for an invalid point.
  virtual std::vector<std::vector<double>> residuals(const std::vector<Point>& points) = 0;
};

}  // namespace calibration
}  // namespace anthrob
