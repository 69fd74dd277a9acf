#include "scope/csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "anthrob_core/testing/random.h"

namespace anthrob {
namespace {

TEST(CsvTest, NoDigitIsLost) {
  testing_support::Random random(5);
  std::vector<Sample> samples;
  for (int i = 0; i < 1000; ++i) {
    const double value = random.uniform(-1.0, 1.0) * std::pow(10.0, random.integer(-300, 300));
    samples.push_back({1700000000123456789 + i * Nanoseconds{1234567}, value});
  }
  std::ostringstream out;
  write_csv("stamp", {{"q", SampleSpan(samples)}}, out);
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "stamp,q");
  for (const Sample& sample : samples) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::size_t comma = line.find(',');
    EXPECT_EQ(line.substr(0, comma), time_text(sample.t));
    EXPECT_EQ(std::strtod(line.c_str() + comma + 1, nullptr), sample.value);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST(CsvTest, EachTimeIsARowAndWhatIsMissingIsEmpty) {
  const std::vector<Sample> a = {{1000000000, 1.0}, {2000000000, 2.0}};
  const std::vector<Sample> b = {{6000000000, 5.0}, {6500000000, 6.0}, {6500000000, 7.0}};
  std::ostringstream out;
  write_csv("t", {{"a", SampleSpan(a)}, {"b", SampleSpan(b), 5000000000}}, out);
  EXPECT_EQ(out.str(), "t,a,b\n1.000,1,5\n1.500,,6\n1.500,,7\n2.000,2,\n");
}

TEST(CsvTest, NamesWithSeparatorsAreQuoted) {
  std::ostringstream out;
  write_csv("t", {{"a,\"b\"", SampleSpan()}}, out);
  EXPECT_EQ(out.str(), "t,\"a,\"\"b\"\"\"\n");
}

}  // namespace
}  // namespace anthrob
