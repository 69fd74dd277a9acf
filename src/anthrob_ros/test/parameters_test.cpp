#include "anthrob_ros/parameters.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/errors.h"

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
  EXPECT_EQ(positive_whole_number_of("k", Value(200)), 200);
  EXPECT_TRUE(truth_of("k", Value(true)));
  EXPECT_EQ(text_of("k", Value("can1")), "can1");
}

TEST(Parameters, OfAnotherTypeAreRefused) {
  // roslaunch and rosparam make a text of it.
  EXPECT_EQ(refusal(number_of, Value("1e-1")), "parameter ~k: '1e-1': expected a number");
  EXPECT_EQ(refusal(number_of, Value(true)), "parameter ~k: true: expected a number");
  EXPECT_EQ(refusal(positive_whole_number_of, Value(2.5)),
            "parameter ~k: 2.5: expected a whole number");
  EXPECT_EQ(refusal(truth_of, Value("yes")), "parameter ~k: 'yes': expected true or false");
  EXPECT_EQ(refusal(truth_of, Value(1)), "parameter ~k: 1: expected true or false");
  EXPECT_EQ(refusal(text_of, Value(0)), "parameter ~k: 0: expected a text");
}

TEST(Parameters, OutOfRangeAreRefused) {
  EXPECT_EQ(positive_number_of("k", Value(0.25)), 0.25);
  EXPECT_EQ(refusal(positive_number_of, Value(0.0)), "parameter ~k: 0: expected a number > 0");
  EXPECT_EQ(nonnegative_number_of("k", Value(0)), 0.0);
  EXPECT_EQ(refusal(nonnegative_number_of, Value(-1)), "parameter ~k: -1: expected a number >= 0");
  EXPECT_EQ(refusal(positive_whole_number_of, Value(0)),
            "parameter ~k: 0: expected a whole number >= 1");
}

TEST(Parameters, FasterThanRealTimeMeasurementsComeTooLate) {
  EXPECT_EQ(real_time_factor_of("k", Value(1)), 1.0);
  EXPECT_EQ(real_time_factor_of("k", Value(0.2)), 0.2);
  for (const double wrong : {0.0, -1.0, 1.5}) {
    EXPECT_NE(refusal(real_time_factor_of, Value(wrong))
                  .find(": expected above 0 and at most 1, because faster than real time"),
              std::string::npos)
        << wrong;
  }
  EXPECT_NE(refusal(real_time_factor_of, Value(std::nan(""))), "");
}

TEST(Parameters, ThatAreNotFiniteAreRefused) {
  EXPECT_EQ(refusal(number_of, Value(HUGE_VAL)), "parameter ~k: inf: expected a finite number");
  EXPECT_EQ(refusal(number_of, Value(-HUGE_VAL)), "parameter ~k: -inf: expected a finite number");
  EXPECT_NE(refusal(number_of, Value(std::nan(""))).find(": expected a finite number"),
            std::string::npos);
}

}  // namespace
}  // namespace anthrob
