#include "optimiser/mpi_evaluator.h"

#define OMPI_SKIP_MPICXX 1  // the C++ bindings are long dead
#include <mpi.h>

namespace anthrob {
namespace calibration {

namespace {

constexpr int kGoHome = -1;

/// Everybody's part of the points, and its fitnesses to rank 0.
std::vector<double> evaluate_together(const hosts::MpiSession& session, Evaluator& local,
                                      std::vector<double>& flat, int count, int dimension) {
  MPI_Bcast(flat.data(), count * dimension, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  std::vector<Point> mine;
  for (int i = session.rank(); i < count; i += session.size()) {
    mine.emplace_back(flat.begin() + i * dimension, flat.begin() + (i + 1) * dimension);
  }
  const std::vector<double> part = mine.empty() ? std::vector<double>{} : local.fitness(mine);
  std::vector<int> counts(session.size(), 0), offsets(session.size(), 0);
  for (int i = 0; i < count; ++i) ++counts[i % session.size()];
  for (int r = 1; r < session.size(); ++r) offsets[r] = offsets[r - 1] + counts[r - 1];
  std::vector<double> gathered(count);
  MPI_Gatherv(part.data(), static_cast<int>(part.size()), MPI_DOUBLE, gathered.data(),
              counts.data(), offsets.data(), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  std::vector<double> fitness(count);
  for (int i = 0; i < count; ++i) {
    fitness[i] = gathered[offsets[i % session.size()] + i / session.size()];
  }
  return fitness;
}

}  // namespace

MpiEvaluator::~MpiEvaluator() {
  int header[2] = {kGoHome, 0};
  if (session_.size() > 1) MPI_Bcast(header, 2, MPI_INT, 0, MPI_COMM_WORLD);
}

std::vector<double> MpiEvaluator::fitness(const std::vector<Point>& points) {
  if (session_.size() == 1 || points.size() == 1) return local_.fitness(points);
  int header[2] = {static_cast<int>(points.size()), static_cast<int>(points.front().size())};
  MPI_Bcast(header, 2, MPI_INT, 0, MPI_COMM_WORLD);
  std::vector<double> flat;
  for (const Point& point : points) flat.insert(flat.end(), point.begin(), point.end());
  return evaluate_together(session_, local_, flat, header[0], header[1]);
}

std::vector<std::vector<double>> MpiEvaluator::residuals(const std::vector<Point>& points) {
  return local_.residuals(points);
}

void serve(const hosts::MpiSession& session, Evaluator& local) {
  for (;;) {
    int header[2] = {kGoHome, 0};
    MPI_Bcast(header, 2, MPI_INT, 0, MPI_COMM_WORLD);
    if (header[0] == kGoHome) return;
    std::vector<double> flat(static_cast<std::size_t>(header[0]) * header[1]);
    evaluate_together(session, local, flat, header[0], header[1]);
  }
}

}  // namespace calibration
}  // namespace anthrob
