#pragma once

#include "anthrob_calib/hosts/mpi_session.h"
#include "optimiser/evaluator.h"

namespace anthrob {
namespace calibration {

/// Evaluator of rank 0. Distributes points over all processes, itself included: point i to process
/// i mod size. Residuals are evaluated on rank 0 only.
class MpiEvaluator final : public Evaluator {
 public:
  MpiEvaluator(const hosts::MpiSession& session, Evaluator& local)
      : session_(session), local_(local) {}
  ~MpiEvaluator() override;  ///< ends serve() in the other processes
  std::vector<double> fitness(const std::vector<Point>& points) override;
  std::vector<std::vector<double>> residuals(const std::vector<Point>& points) override;

 private:
  const hosts::MpiSession& session_;
  Evaluator& local_;
};

/// Evaluates points in a process other than rank 0, until the MpiEvaluator is destroyed.
void serve(const hosts::MpiSession& session, Evaluator& local);

}  // namespace calibration
}  // namespace anthrob
