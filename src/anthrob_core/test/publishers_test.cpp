// Two nodes that publish one measurement.
#include "anthrob_core/publishers.h"

#include <gtest/gtest.h>

namespace anthrob {
namespace {

TEST(Publishers, WhoAlternateAreAConflict) {
  Publishers publishers;
  publishers.add({"shoulder", "elbow"}, "/encoders");
  publishers.add({"wrist"}, "/glove");
  publishers.add({"elbow"}, "/joint_state_publisher");
  EXPECT_FALSE(publishers.conflict());
  publishers.add({"shoulder", "elbow"}, "/encoders");
  ASSERT_TRUE(publishers.conflict());
  EXPECT_EQ(*publishers.conflict(),
            "two nodes publish elbow: /joint_state_publisher and /encoders");
}

TEST(Publishers, OneMayTakeOver) {
  Publishers publishers;
  for (const char* node : {"/simulator", "/simulator", "/driver_1", "/driver_2", "/driver_2"}) {
    publishers.add({"elbow"}, node);
  }
  EXPECT_FALSE(publishers.conflict());
}

TEST(Publishers, UnknownOnesTellNothing) {
  Publishers publishers;
  for (const char* node : {"", "/encoders", "", "/encoders"}) publishers.add({"elbow"}, node);
  EXPECT_FALSE(publishers.conflict());
}

}  // namespace
}  // namespace anthrob
