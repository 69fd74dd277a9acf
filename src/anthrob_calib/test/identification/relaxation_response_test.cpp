// The response of a Maxwell arm against its integral.
#include "identification/relaxation_response.h"

#include <gtest/gtest.h>

#include <cmath>

namespace anthrob {
namespace identification {
namespace {

constexpr double kTau = 0.7;

/// Strain: nothing until 1 s, a ramp of slope 3 for 0.5 s, then held.
double strain_at(double t) {
  return 3.0 * std::min(std::max(t - 1.0, 0.0), 0.5);
}
double response_at(double t) {
  const double up = std::max(t - 1.0, 0.0), over = std::max(t - 1.5, 0.0);
  return 3.0 * kTau * (std::exp(-over / kTau) - std::exp(-up / kTau));
}

struct Sampled {
  std::vector<double> t, strain;
};
Sampled sampled(const std::vector<double>& times) {
  Sampled s{times, {}};
  for (const double t : times) s.strain.push_back(strain_at(t));
  return s;
}

TEST(RelaxationResponse, IsExactHoweverFarSamplesAreApart) {
  // The kinks of the strain are among the samples; everything else is uneven.
  for (const auto& times :
       {std::vector<double>{0.0, 1.0, 1.5, 4.0},
        std::vector<double>{0.2, 0.9, 1.0, 1.01, 1.3, 1.5, 1.50001, 2.0, 9.0}}) {
    const Sampled s = sampled(times);
    const RelaxationResponse r = relaxation_response(s.t, s.strain, kTau);
    for (std::size_t i = 0; i < times.size(); ++i) {
      EXPECT_NEAR(r.h[i], response_at(times[i]), 1e-12) << times[i];
    }
  }
}

TEST(RelaxationResponse, SlopeIsTheDerivative) {
  for (const double spacing : {1e-5, 0.002, 0.3}) {
    std::vector<double> times;
    for (int i = 0; i < 400; ++i) times.push_back(1.0 + spacing * i);
    const Sampled s = sampled(times);
    const double d = 1e-5;
    const auto r = relaxation_response(s.t, s.strain, kTau);
    const auto more = relaxation_response(s.t, s.strain, kTau + d);
    const auto less = relaxation_response(s.t, s.strain, kTau - d);
    for (std::size_t i = 0; i < times.size(); i += 13) {
      EXPECT_NEAR(r.slope[i], (more.h[i] - less.h[i]) / (2.0 * d), 1e-8) << spacing << " " << i;
    }
  }
}

TEST(RelaxationResponse, ExtremeTimesStayFinite) {
  const Sampled s = sampled({0.0, 1.0, 1.2, 1.5, 3.0});
  for (const double tau : {1e-9, 1e9}) {
    const auto r = relaxation_response(s.t, s.strain, tau);
    for (std::size_t i = 0; i < s.t.size(); ++i) {
      EXPECT_TRUE(std::isfinite(r.h[i]) && std::isfinite(r.slope[i]));
      // An arm that never relaxes is a spring.
      if (tau > 1.0) {
        EXPECT_NEAR(r.h[i], s.strain[i], 1e-6);
      }
    }
  }
}

TEST(AverageBackwards, OfTheLastSamples) {
  std::vector<double> series = {4.0, 2.0, 6.0, 1.0};
  average_backwards(series, 2);
  EXPECT_EQ(series, (std::vector<double>{4.0, 3.0, 4.0, 3.5}));
  average_backwards(series, 1);
  EXPECT_EQ(series, (std::vector<double>{4.0, 3.0, 4.0, 3.5}));
}

}  // namespace
}  // namespace identification
}  // namespace anthrob
