#pragma once

#include <string>

#include "anthrob_calib/optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// The processes that mpirun started, or this one alone. One object a process, first thing in
/// main().
class MpiSession {
 public:
  MpiSession(int* argc, char*** argv);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// Everybody calls it, with what went wrong here or an empty text. @return to all: the complaint
  /// of the first process that has one, or an empty text
  std::string first_complaint(const std::string& own) const;
  /// Everybody calls it. @return whether all have the same text
  bool all_have(const std::string& text) const;

 private:
  bool started_ = false;
  int rank_ = 0, size_ = 1;
};

/// Rank 0's evaluator: deals points out to all processes, point i to process i mod size, itself
/// included. Residuals are evaluated here.
class MpiEvaluator final : public Evaluator {
 public:
  MpiEvaluator(const MpiSession& session, Evaluator& local) : session_(session), local_(local) {}
  ~MpiEvaluator() override;  ///< sends the others home
  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

 private:
  const MpiSession& session_;
  Evaluator& local_;
};

/// What the other processes do until rank 0 sends them home.
void serve(const MpiSession& session, Evaluator& local);

}  // namespace calibration
}  // namespace anthrob
