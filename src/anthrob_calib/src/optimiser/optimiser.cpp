#include "optimiser/optimiser.h"

#include "optimiser/evolution_strategy.h"
#include "optimiser/least_squares_optimiser.h"
#include "optimiser/pagmo_optimiser.h"

namespace anthrob {
namespace calibration {

std::unique_ptr<Optimiser> make_optimiser(const OptimiserSettings& settings) {
  if (settings.method == "evolution_strategy") return std::make_unique<EvolutionStrategy>(settings);
  if (settings.method == "least_squares") return std::make_unique<LeastSquaresOptimiser>(settings);
  return std::make_unique<PagmoOptimiser>(settings);
}

}  // namespace calibration
}  // namespace anthrob
