// From the history of tests to what has changed, and when it will be too much.
#include "health/findings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "anthrob_core/random.h"

namespace anthrob {
namespace health {
namespace {

/// What a tendon has on a day, beside noise.
struct DailyChange {
  double stiffness = 0.0, current_gain = 0.0;  ///< as shares
  double creep = 0.0, offset = 0.0;
};

/// A test a day of one tendon, with noise of 1 % and the like.
template <class Change>
History tested_daily(int days, std::uint64_t seed, const Change& change) {
  const CounterRandom random(seed, 3);
  std::uint64_t index = 0;
  const auto noisy = [&](Quantity quantity, double value, double sigma) {
    const double read = value + sigma * random.normal(index++);
    return Figure{quantity, read, read - 2.0 * sigma, read + 2.0 * sigma};
  };
  History history;
  for (int day = 0; day < days; ++day) {
    const DailyChange now = change(day);
    history.add(20000.0 + day,
                {{"brachialis",
                  {noisy(Quantity::kStiffness, 2000.0 * (1.0 + now.stiffness), 20.0),
                   noisy(Quantity::kCurrentGain, 0.008 * (1.0 + now.current_gain), 8e-5),
                   noisy(Quantity::kCreep, 0.1 + now.creep, 0.002),
                   noisy(Quantity::kForceOffset, now.offset, 0.05)},
                  {}}});
  }
  return history;
}

TEST(Findings, OfTendonsThatStayThereAreNone) {
  int told = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    for (const int days : {5, 8, 20, 60}) {
      const auto history = tested_daily(days, seed, [](int) { return DailyChange{}; });
      told += static_cast<int>(findings(history, {}).size());
    }
  }
  EXPECT_LE(told, 2);  // of 640 figures
}

TEST(Findings, FewTestsSayNothing) {
  const auto worn = [](int day) { return DailyChange{-0.2 * day, 0.0, 0.0, 0.0}; };
  EXPECT_TRUE(findings(tested_daily(4, 1, worn), {}).empty());
}

TEST(Findings, ForecastWhenALimitIsReached) {
  // 1 % a day: after 10 days, 10 of the 20 % are gone.
  const auto history = tested_daily(30, 1, [](int day) {
    return DailyChange{-0.01 * std::max(0, day - 19), 0.0, 0.0, 0.0};
  });
  const auto found = findings(history, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].quantities, std::vector<Quantity>{Quantity::kStiffness});
  EXPECT_GT(found[0].days, 5.0);
  EXPECT_LT(found[0].days, 30.0);
  EXPECT_NE(found[0].text().find("softer"), std::string::npos) << found[0].text();
  EXPECT_NE(found[0].text().find("reaches its limit in"), std::string::npos);
}

TEST(Findings, NameTheCauseThatExplainsAll) {
  const struct {
    DailyChange last;
    const char* words;
  } cases[] = {
      {{-0.3, 0.0, 0.1, 0.0}, "frays"},      {{0.25, -0.2, 0.0, 0.0}, "force sensor's gain"},
      {{0.25, 0.0, 0.0, 0.0}, "stiffer"},    {{0.0, 0.25, 0.0, 0.0}, "torque constant"},
      {{0.0, 0.0, 0.1, 0.0}, "creeps more"}, {{0.0, 0.0, 0.0, 3.0}, "zero drifts"}};
  for (const auto& c : cases) {
    const auto history = tested_daily(30, 2, [&](int day) {
      const double share = std::max(0, day - 9) / 20.0;
      return DailyChange{share * c.last.stiffness, share * c.last.current_gain,
                         share * c.last.creep, share * c.last.offset};
    });
    const auto found = findings(history, {});
    ASSERT_EQ(found.size(), 1u) << c.words;
    EXPECT_NE(found[0].cause.find(c.words), std::string::npos) << found[0].text();
    EXPECT_EQ(found[0].days, 0.0);
  }
}

}  // namespace
}  // namespace health
}  // namespace anthrob
