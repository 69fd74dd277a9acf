#include "anthrob_core/force_colour.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

void expect_colour(const Colour& colour, float r, float g, float b) {
  EXPECT_NEAR(colour.r, r, 1e-6f);
  EXPECT_NEAR(colour.g, g, 1e-6f);
  EXPECT_NEAR(colour.b, b, 1e-6f);
}

TEST(ForceColour, FromBlueToRedAndNoFurther) {
  expect_colour(force_colour(0.0), 0.0f, 0.25f, 1.0f);
  expect_colour(force_colour(20.0), 0.5f, 1.0f, 0.0f);
  expect_colour(force_colour(40.0), 1.0f, 0.0f, 0.0f);
  expect_colour(force_colour(-3.0), 0.0f, 0.25f, 1.0f);
  expect_colour(force_colour(1e9), 1.0f, 0.0f, 0.0f);
}

TEST(ForceColour, OfAScaleOfItsOwn) {
  expect_colour(force_colour(50.0, 100.0), 0.5f, 1.0f, 0.0f);
}

TEST(ForceColour, GreyWhereNothingIsMeasured) {
  expect_colour(force_colour(std::nan("")), 0.6f, 0.6f, 0.6f);
}

}  // namespace
}  // namespace anthrob
