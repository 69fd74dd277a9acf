#include "identification/ring_force.h"

#include <cmath>
#include <utility>

#include "identification/relaxation_response.h"

namespace anthrob {
namespace identification {

namespace {

void add(double factor, const std::vector<double>& what, std::vector<double>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * what[i];
}

std::vector<double> scaled(double factor, std::vector<double> list) {
  for (double& value : list) value *= factor;
  return list;
}

/// The arm's response as the sensor shows it.
RelaxationResponse averaged(const std::vector<double>& t, const std::vector<double>& strain,
                            double tau, std::size_t count) {
  RelaxationResponse response = relaxation_response(t, strain, tau);
  average_backwards(response.h, count);
  average_backwards(response.slope, count);
  return response;
}

}  // namespace

RingForce::RingForce(const RingRecording& recording, const RelaxationTest& test)
    : test_(test),
      area_(recording.specimen.area()),
      rest_length_(recording.specimen.rest_length),
      average_(static_cast<std::size_t>(recording.force_average)) {}

void RingForce::evaluate(const double* p, std::size_t arms, std::vector<double>& force,
                         std::vector<std::vector<double>>* derivatives) const {
  const double zero = p[1 + 2 * arms];
  std::vector<double> strain(test_.t.size()), by_zero(test_.t.size());
  for (std::size_t i = 0; i < strain.size(); ++i) {
    const double stretch = test_.expansion[i] - zero;
    // A slack ring has no strain.
    strain[i] = stretch > 0.0 ? stretch / rest_length_ : 0.0;
    by_zero[i] = stretch > 0.0 ? -1.0 / rest_length_ : 0.0;
  }
  force.assign(strain.size(), 0.0);
  std::vector<double> zero_slope(strain.size(), 0.0);
  for (std::size_t a = 0; a < arms; ++a) {
    const double modulus = p[1 + 2 * a], tau = p[2 + 2 * a];
    const RelaxationResponse arm = averaged(test_.t, strain, tau, average_);
    add(area_ * modulus, arm.h, force);
    if (!derivatives) continue;
    add(area_ * modulus, averaged(test_.t, by_zero, tau, average_).h, zero_slope);
    (*derivatives)[1 + 2 * a] = scaled(area_, arm.h);
    (*derivatives)[2 + 2 * a] = scaled(area_ * modulus, arm.slope);
  }
  average_backwards(strain, average_);
  add(area_ * p[0], strain, force);
  if (!derivatives) return;
  average_backwards(by_zero, average_);
  add(area_ * p[0], by_zero, zero_slope);
  (*derivatives)[0] = scaled(area_, strain);
  (*derivatives)[1 + 2 * arms] = std::move(zero_slope);
}

ViscoelasticModel ViscoelasticModel::from_parameters(const double* p, std::size_t arms) {
  ViscoelasticModel model{p[0], {}};
  for (std::size_t a = 0; a < arms; ++a) model.arms.push_back({p[1 + 2 * a], p[2 + 2 * a]});
  return model;
}

std::vector<std::string> parameter_names(std::size_t arms) {
  std::vector<std::string> names = {"E_0"};
  for (std::size_t a = 1; a <= arms; ++a) {
    names.push_back("E_" + std::to_string(a));
    names.push_back("tau_" + std::to_string(a));
  }
  return names;
}

std::vector<double> predicted_force(const ViscoelasticModel& model, double zero,
                                    const RingRecording& recording, const RelaxationTest& test) {
  std::vector<double> p = {model.modulus}, force;
  for (const auto& arm : model.arms) {
    p.push_back(arm.modulus);
    p.push_back(arm.relaxation_time);
  }
  p.push_back(zero);
  RingForce(recording, test).evaluate(p.data(), model.arms.size(), force, nullptr);
  return force;
}

double hold_error(const ViscoelasticModel& model, double zero, const RingRecording& recording,
                  const RelaxationTest& test) {
  const std::vector<double> force = predicted_force(model, zero, recording, test);
  double squares = 0.0;
  for (std::size_t i = test.hold; i < force.size(); ++i) {
    squares += (force[i] - test.force[i]) * (force[i] - test.force[i]);
  }
  return std::sqrt(squares / static_cast<double>(force.size() - test.hold));
}

}  // namespace identification
}  // namespace anthrob
