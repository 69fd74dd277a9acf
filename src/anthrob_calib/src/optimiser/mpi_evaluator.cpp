#include "optimiser/mpi_evaluator.h"

#define OMPI_SKIP_MPICXX 1  // the C++ bindings are long dead
#include <mpi.h>

#include <cstdlib>

namespace anthrob {
namespace calibration {

namespace {

constexpr int kGoHome = -1;

/// Started by mpirun, of Open MPI or of another one?
bool launched_by_mpi() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE") || std::getenv("PMIX_RANK");
}

/// Everybody's part of the points, and its fitnesses to rank 0.
std::vector<double> evaluate_together(const MpiSession& session, Evaluator& local,
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

MpiSession::MpiSession(int* argc, char*** argv) {
  if (!launched_by_mpi()) return;
  // Only the thread that started talks to the others.
  int provided = 0;
  MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  started_ = true;
}

MpiSession::~MpiSession() {
  if (started_) MPI_Finalize();
}

std::optional<std::string> MpiSession::first_complaint(
    const std::optional<std::string>& own) const {
  if (size_ == 1) return own;
  constexpr std::size_t kLongest = 1024;
  std::vector<char> mine(kLongest, '\0'), all(kLongest * static_cast<std::size_t>(size_));
  if (own) own->copy(mine.data(), kLongest - 1);
  MPI_Allgather(mine.data(), kLongest, MPI_CHAR, all.data(), kLongest, MPI_CHAR, MPI_COMM_WORLD);
  for (int r = 0; r < size_; ++r) {
    const std::string complaint(all.data() + kLongest * static_cast<std::size_t>(r));
    if (complaint.empty()) continue;  // that process has none
    return r == 0 ? complaint : complaint + " (process " + std::to_string(r) + ")";
  }
  return std::nullopt;
}

bool MpiSession::all_have(const std::string& text) const {
  if (size_ == 1) return true;
  std::vector<char> first(text.size() + 1, '\0');
  if (rank_ == 0) text.copy(first.data(), text.size());
  auto length = static_cast<unsigned long>(text.size());
  MPI_Bcast(&length, 1, MPI_UNSIGNED_LONG, 0, MPI_COMM_WORLD);
  first.resize(length + 1, '\0');
  MPI_Bcast(first.data(), static_cast<int>(length), MPI_CHAR, 0, MPI_COMM_WORLD);
  int same = std::string(first.data(), length) == text, everywhere = 0;
  MPI_Allreduce(&same, &everywhere, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return everywhere != 0;
}

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

void serve(const MpiSession& session, Evaluator& local) {
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
