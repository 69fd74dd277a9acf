#include "anthrob_calib/hosts/mpi_session.h"

#define OMPI_SKIP_MPICXX 1  // the C++ bindings are long dead
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <thread>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace hosts {

namespace {

/// Started by mpirun, of Open MPI or of another one?
bool launched_by_mpi() {
  return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE") || std::getenv("PMIX_RANK");
}

/// MPI counts bytes by int.
int count_of(std::size_t bytes) {
  if (bytes > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::runtime_error("more than 2 GB between processes at once: expected fewer recordings");
  }
  return static_cast<int>(bytes);
}

/// First letter of a complaint: whose fault it is.
constexpr char bad_input = 'B', other = 'O';

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

void MpiSession::in_all(const std::function<void()>& work) const {
  if (size_ == 1) return work();
  std::string complaint;
  try {
    work();
  } catch (const BadInput& error) {  // the others wait for what is said of it
    complaint = bad_input + std::string(error.what());
  } catch (const std::exception& error) {
    complaint = other + std::string(error.what());
  }
  const std::vector<std::string> all = from_all(complaint);
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (all[r].empty()) continue;
    const std::string said =
        all[r].substr(1) + (r == 0 ? "" : " (process " + std::to_string(r) + ")");
    if (all[r].front() == bad_input) throw BadInput(said);
    throw std::runtime_error(said);
  }
}

bool MpiSession::all_have(const std::string& text) const {
  const std::vector<std::string> all = from_all(text);
  return std::all_of(all.begin(), all.end(), [&](const std::string& one) { return one == text; });
}

std::string MpiSession::from_first(const std::string& bytes) const {
  if (size_ == 1) return bytes;
  int length = count_of(bytes.size());
  MPI_Bcast(&length, 1, MPI_INT, 0, MPI_COMM_WORLD);
  std::string first = rank_ == 0 ? bytes : std::string(static_cast<std::size_t>(length), '\0');
  MPI_Bcast(first.data(), length, MPI_BYTE, 0, MPI_COMM_WORLD);
  return first;
}

std::vector<std::string> MpiSession::from_all(const std::string& bytes) const {
  if (size_ == 1) return {bytes};
  const auto size = static_cast<std::size_t>(size_);
  const int own = count_of(bytes.size());
  std::vector<int> counts(size), offsets(size, 0);
  MPI_Allgather(&own, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::size_t total = 0;
  for (std::size_t r = 0; r < size; ++r) {
    offsets[r] = count_of(total);
    total += static_cast<std::size_t>(counts[r]);
  }
  count_of(total);
  std::string together(total, '\0');
  MPI_Allgatherv(bytes.data(), own, MPI_BYTE, together.data(), counts.data(), offsets.data(),
                 MPI_BYTE, MPI_COMM_WORLD);
  std::vector<std::string> all;
  for (std::size_t r = 0; r < size; ++r) {
    all.push_back(
        together.substr(static_cast<std::size_t>(offsets[r]), static_cast<std::size_t>(counts[r])));
  }
  return all;
}

void MpiSession::abort(int status) const {
  if (rank_ > 0) std::this_thread::sleep_for(std::chrono::seconds(1));
  if (started_) MPI_Abort(MPI_COMM_WORLD, status);
  std::exit(status);
}

std::optional<std::string> MpiSession::remark_on_processors() const {
  const auto may = static_cast<long>(std::thread::hardware_concurrency());
  const long has = sysconf(_SC_NPROCESSORS_ONLN);
  if (size_ == 1 || may >= has) return std::nullopt;
  return "mpirun restricts this process to " + std::to_string(may) + " of " + std::to_string(has) +
         " processors; mpirun --bind-to none lets it use all";
}

}  // namespace hosts
}  // namespace anthrob
