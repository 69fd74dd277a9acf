#pragma once

#include <cstddef>
#include <vector>

namespace anthrob {
namespace identification {

/// Response of a Maxwell arm of unit modulus to a strain that is linear between samples,
///   h(t) = integral over s from t_0 to t of exp(-(t - s) / tau) de(s),
/// in closed form: exact however long the samples are apart. The stress of the arm is E h.
struct RelaxationResponse {
  std::vector<double> h;      ///< one a sample [1]
  std::vector<double> slope;  ///< dh/dtau [1/s]
};

/// Starts relaxed: h = 0 at the first sample.
/// @param t [s], growing   @param strain one a sample [1]   @param tau [s], > 0
RelaxationResponse relaxation_response(const std::vector<double>& t,
                                       const std::vector<double>& strain, double tau);

/// What a sensor shows that averages its last `count` samples (those there are, at the start).
void average_backwards(std::vector<double>& series, std::size_t count);

}  // namespace identification
}  // namespace anthrob
