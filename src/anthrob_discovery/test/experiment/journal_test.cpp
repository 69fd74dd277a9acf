#include "experiment/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

namespace anthrob {
namespace discovery {
namespace journal_test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kContext = 7, kRun = 1, kOtherRun = 2;

class JournalTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }

  /// Of variants that differ by a size, or by a phase in everything.
  static Eigen::VectorXf result(double size, double phase = 0.0) {
    Eigen::VectorXf numbers(20000);
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
      const auto time = static_cast<double>(i);
      const double value = 50.0 * std::sin(37.0 * time + phase) + size * std::sin(0.01 * time);
      numbers[i] = static_cast<float>(std::nearbyint(1024.0 * value) / 1024.0);
    }
    return numbers;
  }

  const std::string file_ =
      (fs::temp_directory_path() / ("anthrob_discovery_journal_" + std::to_string(getpid())))
          .string();
};

TEST_F(JournalTest, KnowsResultsBitForBitAfterwards) {
  {
    Journal journal(file_, kContext);
    journal.append(11, kRun, result(1.0));
    journal.append(12, kRun, {});  // no such robot
    journal.append(13, kRun, result(2.0));
    journal.append(14, kOtherRun, result(3.0).head(500));
    EXPECT_EQ(journal.find(13, kRun).value(), result(2.0));
  }
  Journal journal(file_, kContext);
  EXPECT_EQ(journal.inherited(), 4u);
  // One that others are packed by, after them.
  EXPECT_EQ(journal.find(13, kRun).value(), result(2.0));
  EXPECT_EQ(journal.find(11, kRun).value(), result(1.0));
  EXPECT_EQ(journal.find(12, kRun).value().size(), 0);
  EXPECT_EQ(journal.find(14, kOtherRun).value(), result(3.0).head(500));
  EXPECT_FALSE(journal.find(15, kRun).has_value());
  journal.append(15, kRun, result(4.0));
  EXPECT_EQ(journal.find(15, kRun).value(), result(4.0));
}

TEST_F(JournalTest, WhatTwoThreadsHaveSimulatedIsNotPackedByItself) {
  Journal journal(file_, kContext);
  journal.append(11, kRun, result(1.0));
  journal.append(12, kRun, result(1.0, 2.0));
  const auto size = fs::file_size(file_);
  journal.append(12, kRun, result(1.0, 2.0));  // a thread that was slower
  EXPECT_EQ(fs::file_size(file_), size);
  journal.append(13, kRun, result(1.0, 4.0));
  EXPECT_EQ(journal.find(12, kRun).value(), result(1.0, 2.0));
}

TEST_F(JournalTest, PacksResultsByAnEarlierOne) {
  const auto much = 20000u * 2, little = much / 4;
  const auto append = [&](Journal& journal, std::uint64_t key, const Eigen::VectorXf& numbers) {
    const auto before = key == 11 ? 0 : fs::file_size(file_);
    journal.append(key, kRun, numbers);
    return fs::file_size(file_) - before;
  };
  {
    Journal journal(file_, kContext);
    EXPECT_GT(append(journal, 11, result(1.0)), much);
    EXPECT_LT(append(journal, 12, result(1.1)), little);
    EXPECT_GT(append(journal, 13, result(1.1, 2.0)), much);
    EXPECT_LT(append(journal, 14, result(1.2, 2.0)), little);
  }
  {
    Journal journal(file_, kContext);  // a run that goes on
    EXPECT_EQ(journal.find(13, kRun).value(), result(1.1, 2.0));
    EXPECT_LT(append(journal, 15, result(1.3, 2.0)), little);
  }
  Journal journal(file_, kContext);  // in any order
  EXPECT_EQ(journal.find(15, kRun).value(), result(1.3, 2.0));
  EXPECT_EQ(journal.find(12, kRun).value(), result(1.1));
  EXPECT_EQ(journal.find(14, kRun).value(), result(1.2, 2.0));
  EXPECT_EQ(journal.find(11, kRun).value(), result(1.0));
}

}  // namespace
}  // namespace journal_test
}  // namespace discovery
}  // namespace anthrob
