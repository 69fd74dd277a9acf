#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "experiment/measured_variable.h"
#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

/// 95 % interval of every unknown of a fit, in its own unit, by resampling with the sensitivities
/// of the fit. Deterministic by seed. The half width is the root of the sum of three squares:
/// - blocks of time: noise, and what happens only now and then. With fewer than five blocks, at
/// least what the noise of the floor alone gives;
/// - regimes, each a channel at one level of its place's speed and load, minus the noise, which is
/// in both: a law of another shape is pulled to different sizes by slow and by fast motion, and
/// every block of time contains both;
/// - for parameters of effects, an allowance for another law: a twentieth of the true effect may
/// have another shape, in the direction that moves the parameter most. This is large where ordinary
/// parameters imitate nearly all of an effect.
std::vector<std::pair<double, double>> bootstrap_intervals(
    const Fitted& fitted, const Experiments& experiments,
    const std::vector<MeasuredVariable>& variables, std::uint64_t seed, const FitOptions& options,
    double block);

}  // namespace discovery
}  // namespace anthrob
