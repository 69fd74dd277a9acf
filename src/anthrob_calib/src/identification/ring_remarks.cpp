#include "identification/ring_remarks.h"

#include <cmath>
#include <optional>

#include "anthrob_core/text.h"

namespace anthrob {
namespace identification {

namespace {

constexpr double kOddZero = 0.1;  ///< of the rest length
constexpr double kOddFall = 0.2;  ///< of the modulus: fillers and crystals of rubber do no more

std::optional<std::string> odd_zero(const RingResult& ring, const ViscoelasticFit& fit) {
  const double rest = ring.recordings[ring.fitted].specimen.rest_length;
  if (!fit.zero || std::abs(fit.zero->value) < kOddZero * rest) return std::nullopt;
  return "zero of the expansion " + significant(1000.0 * fit.zero->value, 3) +
         " mm, for a ring of " + significant(1000.0 * rest, 3) +
         " mm: is rig.start_length right (in m, at position zero)? does the position begin at "
         "zero?";
}

/// By the fits of single strains, which know no zero.
std::optional<std::string> falling_modulus(const ViscoelasticFit& fit) {
  const LevelFit *low = nullptr, *high = nullptr;
  for (const LevelFit& level : fit.levels) {
    if (!level.used) continue;
    if (!low || level.strain < low->strain) low = &level;
    if (!high || level.strain > high->strain) high = &level;
  }
  if (!low || low == high) return std::nullopt;
  const Estimate &before = low->parameters.front(), &after = high->parameters.front();
  if (!(after.hi < before.lo && after.value < (1.0 - kOddFall) * before.value)) return std::nullopt;
  return "E_0 falls from " + significant(1e-6 * before.value, 3) + " MPa at strain " +
         significant(low->strain, 3) + " to " + significant(1e-6 * after.value, 3) +
         " MPa at strain " + significant(high->strain, 3) +
         ": is rig.effective_radius right? does the line slip, or the force sensor saturate?";
}

}  // namespace

std::vector<std::string> remarks_on(const RingResult& ring) {
  std::vector<std::string> remarks;
  const RingModelResult* model = ring.better();
  if (!model) return remarks;
  for (const auto& text : {odd_zero(ring, *model->fit), falling_modulus(*model->fit)}) {
    if (text) remarks.push_back(ring.ring + " " + model->name() + ": " + *text);
  }
  return remarks;
}

}  // namespace identification
}  // namespace anthrob
