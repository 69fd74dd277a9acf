#include "anthrob_reference/ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

#include "scalar_system.h"

namespace anthrob::reference {
namespace {

RingParameters ring_15x5() {
  RingParameters ring;
  ring.rest_length = 0.015;
  ring.section_diameter = 0.005;
  ring.strands = 2.0;
  ring.quantity = 2.0;
  ring.modulus = 0.8129e6;
  ring.arm_modulus = 0.1375e6;
  ring.relaxation_time = 1.2886;
  return ring;
}

TEST(Ring, PullsWithAllItsStrands) {
  const Ring ring(ring_15x5());
  const double strain = ring.strain(0.018);
  EXPECT_NEAR(strain, 0.2, 1e-12);
  const double area = 4.0 * M_PI * 0.0025 * 0.0025;
  EXPECT_NEAR(ring.force(strain, 0.0), area * (0.8129e6 + 0.1375e6) * 0.2, 1e-9);
  // For ever after: the arm has let go (4.52). 4256 N/m is the stiffness of this ring.
  EXPECT_NEAR(ring.force(strain, ring.relaxed(strain)), area * 0.8129e6 * 0.2, 1e-9);
  EXPECT_NEAR(ring.force(strain, ring.relaxed(strain)) / 0.003, 4256.0, 1.0);
}

TEST(Ring, SlackRingNeitherPushesNorForgets) {
  const Ring ring(ring_15x5());
  EXPECT_EQ(ring.strain(0.014), 0.0);
  EXPECT_EQ(ring.force(0.0, 1e4), 0.0);
  EXPECT_NEAR(ring.rate(0.0, 1e4), -1e4 / 1.2886, 1e-9);
}

TEST(Ring, RelaxesAsAZenerSolid) {
  // (4.59) with one Maxwell arm, after a step of the strain.
  const Ring ring(ring_15x5());
  const double strain = 0.5;
  const double area = 4.0 * M_PI * 0.0025 * 0.0025;
  ScalarSystem system([&](double y) { return ring.rate(strain, y); });
  const double dt = 5e-3;
  for (int k = 1; k <= 600; ++k) {
    const double y = system.step(dt);
    const double stress = (0.8129e6 + 0.1375e6 * std::exp(-k * dt / 1.2886)) * strain;
    EXPECT_NEAR(ring.force(strain, y), area * stress, 1e-9 * area * stress);
  }
}

TEST(Ring, RefusesWhatHasNoMeaning) {
  RingParameters parameters = ring_15x5();
  parameters.relaxation_time = 0.0;
  EXPECT_THROW(Ring{parameters}, std::invalid_argument);
  parameters = ring_15x5();
  parameters.quantity = -1.0;
  EXPECT_THROW(Ring{parameters}, std::invalid_argument);
}

}  // namespace
}  // namespace anthrob::reference
