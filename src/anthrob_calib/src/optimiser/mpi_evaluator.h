#pragma once

#include <optional>
#include <string>

#include "optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// The processes that mpirun started, or only this one. Create one object per process, at the
/// beginning of main().
class MpiSession {
 public:
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// All processes must call it.
  /// @param own error message of this process, not empty, if it has one
  /// @return in all processes the first error message by rank, if there is one
  std::optional<std::string> first_complaint(const std::optional<std::string>& own) const;
  /// All processes must call it. @return whether all have the same text
  bool all_have(const std::string& text) const;

 private:
  bool started_ = false;
  int rank_ = 0, size_ = 1;
};

/// Evaluator of rank 0. Distributes points over all processes, itself included: point i to process
/// i mod size. Residuals are evaluated on rank 0 only.
class MpiEvaluator final : public Evaluator {
 public:
  MpiEvaluator(const MpiSession& session, Evaluator& local) : session_(session), local_(local) {}
  ~MpiEvaluator() override;  ///< ends serve() in the other processes
  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

 private:
  const MpiSession& session_;
  Evaluator& local_;
};

/// Evaluates points in a process other than rank 0, until the MpiEvaluator is destroyed.
void serve(const MpiSession& session, Evaluator& local);

}  // namespace calibration
}  // namespace anthrob
