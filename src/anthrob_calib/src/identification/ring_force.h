#pragma once

#include <string>
#include <vector>

#include "identification/ring_recording.h"

namespace anthrob {
namespace identification {

/// A spring in parallel with Maxwell arms: one arm is the Zener model (4.47)-(4.56), two the
/// Wiechert model (4.57)-(4.59) of the thesis.
struct ViscoelasticModel {
  struct Arm {
    double modulus;          ///< E_i [Pa]
    double relaxation_time;  ///< tau_i [s]
  };
  double modulus;  ///< E_0 [Pa]
  std::vector<Arm> arms;

  /// In the order E_0, E_1, tau_1, E_2, tau_2, ...
  static ViscoelasticModel from_parameters(const double* parameters, std::size_t arms);
};

/// "E_0", "E_1", "tau_1", ...
std::vector<std::string> parameter_names(std::size_t arms);

/// Force of a ring in one test as a function of its parameters: the response of the model to the
/// measured expansion, as the averaging force sensor shows it.
class RingForce {
 public:
  /// @param recording, test must outlive this
  RingForce(const RingRecording& recording, const RelaxationTest& test);

  /// For every sample of the test [N].
  /// @param parameters E_0, E_1, tau_1, ..., and the zero of the expansion
  /// @param derivatives one list a parameter; null if not wanted
  void evaluate(const double* parameters, std::size_t arms, std::vector<double>& force,
                std::vector<std::vector<double>>* derivatives) const;

 private:
  const RelaxationTest& test_;
  double area_, rest_length_;
  std::size_t average_;
};

/// Force that the sensor shows in a test, at every sample [N].
/// @param zero expansion by the spindle at which the ring begins to stretch [m]
std::vector<double> predicted_force(const ViscoelasticModel& model, double zero,
                                    const RingRecording& recording, const RelaxationTest& test);

/// Root mean square error of the force while the strain is held [N].
double hold_error(const ViscoelasticModel& model, double zero, const RingRecording& recording,
                  const RelaxationTest& test);

}  // namespace identification
}  // namespace anthrob
