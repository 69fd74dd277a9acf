#include "anthrob_ros/parameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "anthrob_config/errors.h"

namespace anthrob {
namespace {

using Value = XmlRpc::XmlRpcValue;

template <typename Read>
std::string refusal(Read read, const Value& value) {
  try {
    read("k", value);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Parameters, AreTakenInTheirType) {
  EXPECT_EQ(number_of("k", Value(0.25)), 0.25);
  EXPECT_EQ(number_of("k", Value(200)), 200.0);
  EXPECT_EQ(whole_number_of("k", Value(200)), 200);
  EXPECT_TRUE(truth_of("k", Value(true)));
  EXPECT_EQ(text_of("k", Value("can1")), "can1");
}

TEST(Parameters, OfAnotherTypeAreRefused) {
  // roslaunch and rosparam make a text of it.
  EXPECT_EQ(refusal(number_of, Value("1e-1")), "parameter ~k: expected a number");
  EXPECT_EQ(refusal(number_of, Value(true)), "parameter ~k: expected a number");
  EXPECT_EQ(refusal(whole_number_of, Value(2.5)), "parameter ~k: expected a whole number");
  EXPECT_EQ(refusal(truth_of, Value("yes")), "parameter ~k: expected true or false");
  EXPECT_EQ(refusal(truth_of, Value(1)), "parameter ~k: expected true or false");
  EXPECT_EQ(refusal(text_of, Value(0)), "parameter ~k: expected a text");
}

TEST(Parameters, ThatAreNotFiniteAreRefused) {
  for (const double value : {std::nan(""), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
    EXPECT_EQ(refusal(number_of, Value(value)), "parameter ~k: expected a finite number");
  }
}

}  // namespace
}  // namespace anthrob
