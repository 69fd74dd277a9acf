// Optimisers on functions whose minimum is known, and what the journal does for them.
#include "optimiser/optimiser.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

#include "anthrob_core/errors.h"
#include "optimiser/descent.h"
#include "optimiser/journal.h"
#include "optimiser/least_squares_optimiser.h"

namespace anthrob {
namespace calibration {
namespace {

/// A function as an evaluator; remembers what it was asked.
class Function final : public Evaluator {
 public:
  explicit Function(std::function<std::vector<double>(const Point&)> residuals)
      : residuals_(std::move(residuals)) {}

  std::vector<double> fitness(const std::vector<Point>& points) override {
    std::vector<double> fitness;
    for (const auto& list : residuals(points)) {
      double square = list.empty() ? HUGE_VAL : 0.0;
      for (const double r : list) square += r * r;
      fitness.push_back(square);
    }
    return fitness;
  }

  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override {
    std::vector<std::vector<double>> lists;
    for (const Point& point : points) {
      asked.push_back(point);
      lists.push_back(residuals_(point));
    }
    return lists;
  }

  std::vector<Point> asked;

 private:
  std::function<std::vector<double>(const Point&)> residuals_;
};

std::vector<double> sphere(const Point& p) {
  return p;
}

std::vector<SearchVariable> variables(int n, double initial, double bound = 100.0) {
  return std::vector<SearchVariable>(n, {initial, -bound, bound, 0.5});
}

OptimiserSettings settings(const std::string& method, int generations, std::uint64_t seed = 1) {
  OptimiserSettings s;
  s.method = method;
  s.generations = generations;
  s.seed = seed;
  return s;
}

SearchResult search(const OptimiserSettings& s, const std::vector<SearchVariable>& v,
                    Evaluator& evaluator) {
  return make_optimiser(s)->minimise(v, evaluator);
}

/// log10 of the best fitness after so many generations, mean over seeds.
double progress(int generations) {
  constexpr int kSeeds = 10;
  double sum = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    Function function(sphere);
    sum += std::log10(
        search(settings("evolution_strategy", generations, seed), variables(10, 3.0), function)
            .fitness);
  }
  return sum / kSeeds;
}

TEST(EvolutionStrategy, ConvergesLinearlyOnTheSphere) {
  // Self-adaptation keeps the step in proportion to the distance: the logarithm falls steadily.
  const double at_0 = std::log10(90.0), at_60 = progress(60), at_120 = progress(120);
  EXPECT_LT(at_60, at_0 - 2.5);
  EXPECT_NEAR(at_120 - at_60, at_60 - at_0, 0.35 * (at_0 - at_60));
}

TEST(EvolutionStrategy, MutationsAreSpreadAsEquationsSay) {
  // y + s exp(N/sqrt(2n)) exp(N/sqrt(2 sqrt n)) N has the variance s^2 exp(1/n + 1/sqrt n).
  constexpr int n = 4, kCount = 40000;
  OptimiserSettings s = settings("evolution_strategy", 1);
  s.offspring = kCount;
  Function function(sphere);
  search(s, variables(n, 1.0, 1e6), function);
  double square = 0.0;
  for (const Point& p : function.asked) {
    for (const double y : p) square += (y - 1.0) * (y - 1.0);
  }
  const double expected = 0.25 * std::exp(1.0 / n + 1.0 / std::sqrt(n));
  EXPECT_NEAR(square / (n * kCount), expected, 0.05 * expected);
}

TEST(EvolutionStrategy, StaysWithinBounds) {
  // The minimum lies outside; values at a bound start there.
  std::vector<SearchVariable> v = variables(3, 2.0);
  for (SearchVariable& x : v) x.lower = 1.0, x.upper = 2.0;
  Function function(sphere);
  const SearchResult result = search(settings("evolution_strategy", 40), v, function);
  for (const Point& p : function.asked) {
    for (const double y : p) {
      EXPECT_GE(y, 1.0);
      EXPECT_LE(y, 2.0);
    }
  }
  EXPECT_NEAR(result.fitness, 3.0, 0.05);
}

TEST(EvolutionStrategy, KeepsTheBestEver) {
  // The world gets worse with every evaluation: comma selection loses what was best.
  int evaluations = 0;
  Function function([&](const Point&) { return Point{1.0 + ++evaluations}; });
  const SearchResult result =
      search(settings("evolution_strategy", 5), variables(2, 0.0), function);
  EXPECT_DOUBLE_EQ(result.fitness, 4.0);
  EXPECT_EQ(result.best, function.asked.front());
  EXPECT_EQ(evaluations, 5 * 36);
}

TEST(EvolutionStrategy, DoesNotSelectInvalidIndividuals) {
  Function half([](const Point& p) { return p[0] < 2.0 ? Point{} : p; });
  const SearchResult result = search(settings("evolution_strategy", 60), variables(3, 3.0), half);
  EXPECT_GE(result.best[0], 2.0);
  EXPECT_NEAR(result.fitness, 4.0, 0.2);

  Function none([](const Point&) { return Point{}; });
  const SearchResult nothing = search(settings("evolution_strategy", 60), variables(3, 3.0), none);
  EXPECT_EQ(nothing.reason, "no valid individual left");
  EXPECT_EQ(none.asked.size(), 36u);
}

TEST(EvolutionStrategy, StopsAtTheTarget) {
  OptimiserSettings s = settings("evolution_strategy", 1000);
  s.target = 1.0;
  Function function(sphere);
  const SearchResult result = search(s, variables(5, 3.0), function);
  EXPECT_EQ(result.reason, "target reached");
  EXPECT_LT(result.fitness, 1.0);
}

class EveryMethod : public testing::TestWithParam<const char*> {};

TEST_P(EveryMethod, FindsAMinimumAndTheSameOneAgain) {
  Function first(sphere), second(sphere), other(sphere);
  const auto v = variables(4, 3.0);
  const SearchResult a = search(settings(GetParam(), 60), v, first);
  const SearchResult b = search(settings(GetParam(), 60), v, second);
  EXPECT_LT(a.fitness, 0.05) << a.reason;
  EXPECT_EQ(a.best, b.best);
  EXPECT_EQ(first.asked, second.asked);
  if (std::string(GetParam()) == "least_squares") return;
  search(settings(GetParam(), 60, 2), v, other);
  EXPECT_NE(first.asked, other.asked);
}

INSTANTIATE_TEST_SUITE_P(All, EveryMethod,
                         testing::Values("evolution_strategy", "cmaes", "sade", "bee_colony",
                                         "least_squares"));

TEST(LeastSquares, SolvesRosenbrockAtABound) {
  Function rosenbrock([](const Point& p) {
    return Point{10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]};
  });
  std::vector<SearchVariable> v = {{-1.2, -5.0, 5.0, 0.01}, {1.0, -5.0, 5.0, 0.01}};
  EXPECT_LT(search(settings("least_squares", 100), v, rosenbrock).fitness, 1e-3);
  v[0].upper = 0.5;
  const SearchResult bounded = search(settings("least_squares", 100), v, rosenbrock);
  EXPECT_NEAR(bounded.best[0], 0.5, 1e-6);
  EXPECT_NEAR(bounded.fitness, 0.25, 1e-3);
}

TEST(LeastSquares, DifferencesStayWithinNarrowBounds) {
  Function function([](const Point& p) { return Point{p[0] - 1.0, p[1] + 1.0}; });
  const std::vector<SearchVariable> v = {{0.0, -0.2, 0.3, 1.0}, {0.1, -0.1, 0.1, 1.0}};
  search(settings("least_squares", 20), v, function);
  ASSERT_FALSE(function.asked.empty());
  for (const Point& point : function.asked) {
    for (std::size_t i = 0; i < point.size(); ++i) {
      EXPECT_GE(point[i], v[i].lower);
      EXPECT_LE(point[i], v[i].upper);
    }
  }
}

TEST(LeastSquares, TakesFewJacobians) {
  constexpr std::size_t kCount = 10;
  Function curved([](const Point& p) {
    Point r;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const double next = p[(i + 1) % p.size()];
      r.push_back(p[i] + (0.15 + 0.03 * static_cast<double>(i)) * next * next - 1.0);
    }
    return r;
  });
  const std::vector<SearchVariable> v(kCount, {0.0, -5.0, 5.0, 0.1});
  Point start;
  for (std::size_t i = 0; i < kCount; ++i) start.push_back(-1.0 + 0.1 * static_cast<double>(i));
  int jacobians = 2;
  EXPECT_LT(descend(v, 0.02, start, curved, jacobians).fitness, 1e-6);
  EXPECT_LT(curved.asked.size(), 5 * kCount);
}

TEST(LeastSquares, LeavesABoundThatItWasHeldAt) {
  // At the start the first one is pushed below its bound, by what the second one is too small.
  Function coupled([](const Point& p) { return Point{p[0] + 3.0 - p[1], 0.5 * (p[1] - 5.0)}; });
  int jacobians = 5;
  const Descent down = descend({{0.0, 0.0, 10.0, 0.1}, {0.0, -10.0, 10.0, 0.1}}, 0.02, {0.0, 0.0},
                               coupled, jacobians);
  EXPECT_NEAR(down.point[0], 2.0, 1e-3);
  EXPECT_NEAR(down.point[1], 5.0, 1e-3);
}

/// The best lies behind many bounds: what a step would gain beyond them must not count.
TEST(LeastSquares, GoesAlongBoundsWithFullTrust) {
  constexpr std::size_t kCount = 12;
  Function pulled([](const Point& p) {
    Point r;
    for (std::size_t i = 0; i + 1 < p.size(); i += 2) {
      r.push_back(10.0 * (p[i] + p[i + 1]));  // wants beyond the first one's bound
      r.push_back(p[i + 1] - 3.0);
    }
    return r;
  });
  std::vector<SearchVariable> v(kCount, {0.5, 0.0, 4.0, 0.1});
  int jacobians = 3;
  const Descent down = descend(v, 0.02, Point(kCount, 0.5), pulled, jacobians);
  // With the first ones at 0 the second ones do best at 3 / 101.
  for (std::size_t i = 0; i < kCount; i += 2) {
    EXPECT_EQ(down.point[i], 0.0);
    EXPECT_NEAR(down.point[i + 1], 3.0 / 101.0, 1e-4);
  }
}

TEST(LeastSquares, GoesOnWhereItSeesABetterValley) {
  Function two_valleys([](const Point& p) { return Point{p[0] * p[0] - 1.0, 0.4 * (p[0] - 1.0)}; });
  const std::vector<SearchVariable> v = {{-1.2, -4.0, 4.0, 0.2}};
  const SearchResult result = search(settings("least_squares", 100), v, two_valleys);
  EXPECT_NEAR(result.best[0], 1.0, 1e-3);
  EXPECT_EQ(result.reason, "converged");
  // The first one, with nothing better in sight.
  const SearchResult near =
      search(settings("least_squares", 100), {{-1.2, -1.5, 0.0, 0.2}}, two_valleys);
  EXPECT_LT(near.best[0], -0.8);
}
TEST(LeastSquares, TellsWhatChangesNothing) {
  Function function([](const Point& p) { return Point{p[0] - 3.0, 2.0 * p[0]}; });
  const std::vector<SearchVariable> v = {{1.0, -5.0, 5.0, 0.1}, {0.5, -5.0, 5.0, 0.1}};
  const SearchResult result = search(settings("least_squares", 5), v, function);
  ASSERT_EQ(result.sensitivity.size(), 2u);
  EXPECT_NEAR(result.sensitivity[0], 0.1 * std::sqrt(5.0), 1e-9);
  EXPECT_EQ(result.sensitivity[1], 0.0);
  EXPECT_TRUE(search(settings("evolution_strategy", 5), v, function).sensitivity.empty());
}

TEST(LeastSquares, WhereOneNeighbourIsInvalidTheOtherTells) {
  const std::vector<SearchVariable> v = {{1.0, -5.0, 5.0, 0.1}, {0.5, -5.0, 5.0, 0.1}};
  // Valid up to 1 only.
  Function edge([](const Point& p) { return p[0] > 1.0 ? Point{} : Point{3.0 + 2 * p[0], p[1]}; });
  auto columns = derivatives(v, {1.0, 0.5}, {5.0, 0.5}, 0.02, edge);
  EXPECT_NEAR(columns[0][0], 0.2, 1e-9);
  EXPECT_EQ(columns[0][1], 0.0);
  EXPECT_NEAR(columns[1][1], 0.1, 1e-9);
  // Valid at 1 only.
  Function point([](const Point& p) { return p[0] != 1.0 ? Point{} : Point{3.0 + p[0], p[1]}; });
  columns = derivatives(v, {1.0, 0.5}, {4.0, 0.5}, 0.02, point);
  EXPECT_EQ(columns[0], (Point{0.0, 0.0}));
  EXPECT_NEAR(columns[1][1], 0.1, 1e-9);
}

class JournalTest : public testing::Test {
 protected:
  JournalTest() { std::filesystem::create_directories(folder_); }
  ~JournalTest() override { std::filesystem::remove_all(folder_); }

  Journal::Options options(bool resume, int stop_after = 1 << 30) {
    Journal::Options o;
    o.file = file_;
    o.fingerprint = "robot";
    o.resume = resume;
    o.stop = [this, stop_after] { return static_cast<int>(function_.asked.size()) >= stop_after; };
    return o;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("journal_" + std::to_string(getpid()));
  const std::string file_ = (folder_ / "journal.txt").string();
  Function function_{sphere};
};

TEST_F(JournalTest, LongEvaluationsAreWrittenBeforeTheirBatchIsFull) {
  for (const double patience : {1e9, 0.0}) {
    Journal::Options o = options(false);
    o.batch = 1000;
    o.patience = patience;
    Journal journal(function_, o);
    journal.fitness({{0.5, 0.5, 0.5}});
    std::ifstream in(file_);
    int lines = 0;
    for (std::string line; std::getline(in, line);) ++lines;
    EXPECT_EQ(lines, patience > 0.0 ? 2 : 3);
  }
}

TEST_F(JournalTest, ItsFolderServesOneRunAtATime) {
  {
    const Journal first(function_, options(false));
    EXPECT_THROW(Journal(function_, options(true)), BadInput);
    EXPECT_THROW(Journal(function_, options(false)), BadInput);
  }
  EXPECT_NO_THROW(Journal(function_, options(true)));
}

TEST_F(JournalTest, AnyMethodResumesToTheSameBits) {
  for (const char* method : {"evolution_strategy", "cmaes", "sade", "bee_colony"}) {
    const auto v = variables(4, 3.0);
    Function plain(sphere);
    Journal whole(plain, {"", "robot"});
    search(settings(method, 30), v, whole);

    function_.asked.clear();
    {
      Journal journal(function_, options(false, 500));
      EXPECT_THROW(search(settings(method, 30), v, journal), Interrupted);
      journal.save();
    }
    const std::size_t before = function_.asked.size();
    ASSERT_LT(before, plain.asked.size());
    Journal journal(function_, options(true));
    search(settings(method, 30), v, journal);
    EXPECT_EQ(journal.best(), whole.best()) << method;
    EXPECT_EQ(journal.best_fitness(), whole.best_fitness()) << method;
    EXPECT_EQ(function_.asked, plain.asked) << method;  // nothing was asked twice
    EXPECT_EQ(journal.replayed(), static_cast<int>(before));
    ASSERT_EQ(journal.history().size(), whole.history().size());
    EXPECT_EQ(journal.history().back().best_ever, whole.best_fitness());
  }
}

TEST_F(JournalTest, LeastSquaresResumeWithoutAskingAgain) {
  const auto rosenbrock = [](const Point& p) {
    return Point{10.0 * (p[1] - p[0] * p[0]), 1.0 - p[0]};
  };
  const std::vector<SearchVariable> v = {{-1.2, -5.0, 5.0, 0.01}, {1.0, -5.0, 5.0, 0.01}};
  Function plain(rosenbrock);
  Journal whole(plain, {"", "robot"});
  search(settings("least_squares", 30), v, whole);

  function_ = Function(rosenbrock);
  const auto lists = std::filesystem::path(file_).parent_path() / "residuals.bin";
  {
    Journal journal(function_, options(false, 20));
    EXPECT_THROW(search(settings("least_squares", 30), v, journal), Interrupted);
  }
  EXPECT_TRUE(std::filesystem::exists(lists));
  const std::size_t before = function_.asked.size();
  ASSERT_LT(before, plain.asked.size());
  Journal journal(function_, options(true));
  search(settings("least_squares", 30), v, journal);
  EXPECT_EQ(journal.best(), whole.best());
  EXPECT_EQ(journal.evaluations(), whole.evaluations());
  EXPECT_GE(journal.replayed(), static_cast<int>(before));
  std::sort(function_.asked.begin(), function_.asked.end());
  const auto twice = std::adjacent_find(function_.asked.begin(), function_.asked.end());
  EXPECT_EQ(twice, function_.asked.end());
  journal.forget_residuals();
  EXPECT_FALSE(std::filesystem::exists(lists));
}

TEST_F(JournalTest, RefusesWhatItDoesNotBelongTo) {
  EXPECT_THROW(Journal(function_, options(true)), BadInput);  // nothing there
  {
    Journal journal(function_, options(false));
    search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
    journal.save();
  }
  Journal::Options other = options(true);
  other.fingerprint = "another robot";
  EXPECT_THROW(Journal(function_, other), BadInput);
  Journal same(function_, options(true));
  EXPECT_FALSE(same.outdated());
  EXPECT_THROW(search(settings("evolution_strategy", 3, 2), variables(2, 1.0), same), BadInput);
}

class DamagedJournalTest : public JournalTest {
 protected:
  DamagedJournalTest() {
    Journal journal(function_, options(false));
    search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
    journal.save();
    std::ifstream in(file_);
    for (std::string line; std::getline(in, line);) lines_.push_back(line);
  }

  /// @return what is said when a journal of these lines is resumed
  std::string refusal(const std::vector<std::string>& lines) {
    write(lines);
    try {
      Journal(function_, options(true));
    } catch (const BadInput& error) {
      return error.what();
    }
    return "nothing";
  }

  void write(const std::vector<std::string>& lines) const {
    std::ofstream out(file_);
    for (const std::string& line : lines) out << line << "\n";
  }

  std::vector<std::string> lines_;
};

TEST_F(DamagedJournalTest, AChangedLineIsRefusedByItsNumber) {
  ASSERT_GT(lines_.size(), 20u);
  EXPECT_EQ(refusal(lines_), "nothing");
  const auto expect_refused = [&](const std::vector<std::string>& lines, std::size_t number) {
    EXPECT_EQ(refusal(lines).find(file_ + ":" + std::to_string(number) + ": damaged"), 0u)
        << refusal(lines);
  };
  auto better = lines_;  // a fitness that no parameters have
  const std::size_t fitness = better[9].find(' ') + 1;
  better[9].replace(fitness, better[9].rfind(' ') - fitness, "1e-30");
  expect_refused(better, 10);
  auto flipped = lines_;
  flipped[2][3] ^= 1;
  expect_refused(flipped, 3);
  auto swapped = lines_;
  std::swap(swapped[7], swapped[8]);
  expect_refused(swapped, 8);
  auto without_one = lines_;
  without_one.erase(without_one.begin() + 5);
  expect_refused(without_one, 6);
  auto cut_off = lines_;
  cut_off[6] = cut_off[6].substr(0, 20);
  expect_refused(cut_off, 7);
  auto gone = lines_;
  gone[6].clear();
  expect_refused(gone, 7);
}

TEST_F(DamagedJournalTest, OfACutOffEndTheRestCounts) {
  const int whole = static_cast<int>(lines_.size()) - 2;
  for (const std::size_t left : {0u, 1u, 17u, 30u}) {
    auto lines = lines_;
    lines.back() = lines.back().substr(0, left);
    write(lines);
    Journal journal(function_, options(true));
    ASSERT_TRUE(journal.remark()) << left;
    EXPECT_EQ(journal.remark()->find(file_ + ":" + std::to_string(lines.size()) + ": "), 0u)
        << *journal.remark();
    search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
    EXPECT_LT(journal.replayed(), whole);
    EXPECT_EQ(journal.evaluations(), whole);
    journal.save();
    std::ifstream in(file_);
    std::vector<std::string> again;
    for (std::string line; std::getline(in, line);) again.push_back(line);
    EXPECT_EQ(again, lines_);
  }
}

TEST_F(DamagedJournalTest, OneWithoutChecksumsIsFoundAnew) {
  auto former = lines_;
  former[0].replace(former[0].find(" 3 "), 3, " 2 ");
  for (std::size_t i = 2; i < former.size(); ++i) {
    former[i] = former[i].substr(0, former[i].find(' ')) + " 1e-30";
  }
  write(former);
  Journal journal(function_, options(true));
  EXPECT_TRUE(journal.outdated());
  search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
  EXPECT_EQ(journal.replayed(), 0);
  EXPECT_GT(journal.best_fitness(), 1e-29);
}

TEST_F(JournalTest, WhatAnotherBuildFoundIsFoundAnew) {
  {
    Journal journal(function_, options(false));
    search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
    journal.save();
  }
  for (const bool first : {true, false}) {
    Journal::Options newer = options(true);
    newer.program = 7;
    Journal journal(function_, newer);
    EXPECT_EQ(journal.outdated(), first);
    search(settings("evolution_strategy", 3), variables(2, 1.0), journal);
    EXPECT_EQ(journal.replayed(), first ? 0 : journal.evaluations());
    journal.save();
  }
}

}  // namespace
}  // namespace calibration
}  // namespace anthrob
