#include "optimiser/mpi_evaluator.h"

#include <cstring>
#include <string>

namespace anthrob {
namespace calibration {

namespace {

std::string bytes_of(const std::vector<double>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

std::vector<double> numbers_in(const std::string& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(double));
  std::memcpy(numbers.data(), bytes.data(), bytes.size());
  return numbers;
}

/// How many points there are, then these; empty: there will be none.
std::string bytes_of(const std::vector<Point>& points) {
  std::vector<double> numbers = {static_cast<double>(points.size())};
  for (const Point& point : points) numbers.insert(numbers.end(), point.begin(), point.end());
  return bytes_of(numbers);
}

/// Everybody's part of the points, and the fitnesses of all.
std::vector<double> evaluate_together(const hosts::MpiSession& session, Evaluator& local,
                                      const std::string& bytes) {
  const std::vector<double> numbers = numbers_in(bytes);
  const auto count = static_cast<std::size_t>(numbers.front());
  const std::size_t dimension = (numbers.size() - 1) / count;
  const auto size = static_cast<std::size_t>(session.size());
  std::vector<Point> mine;
  for (auto i = static_cast<std::size_t>(session.rank()); i < count; i += size) {
    const auto begin = numbers.begin() + static_cast<std::ptrdiff_t>(1 + i * dimension);
    mine.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(dimension));
  }
  const std::vector<double> part = mine.empty() ? std::vector<double>{} : local.fitness(mine);
  std::vector<double> fitness(count);
  const std::vector<std::string> all = session.from_all(bytes_of(part));
  for (std::size_t r = 0; r < size; ++r) {
    const std::vector<double> own = numbers_in(all[r]);
    for (std::size_t k = 0; k < own.size(); ++k) fitness[r + k * size] = own[k];
  }
  return fitness;
}

}  // namespace

MpiEvaluator::~MpiEvaluator() {
  session_.from_first({});  // nothing more
}

std::vector<double> MpiEvaluator::fitness(const std::vector<Point>& points) {
  if (session_.size() == 1 || points.size() == 1) return local_.fitness(points);
  return evaluate_together(session_, local_, session_.from_first(bytes_of(points)));
}

std::vector<std::vector<double>> MpiEvaluator::residuals(const std::vector<Point>& points) {
  return local_.residuals(points);
}

void serve(const hosts::MpiSession& session, Evaluator& local) {
  for (;;) {
    const std::string points = session.from_first({});
    if (points.empty()) return;
    evaluate_together(session, local, points);
  }
}

}  // namespace calibration
}  // namespace anthrob
