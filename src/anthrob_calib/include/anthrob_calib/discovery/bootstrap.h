#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "anthrob_calib/discovery/measured_variable.h"
#include "anthrob_calib/discovery/model_fit.h"

namespace anthrob {
namespace discovery {

/// 95 % interval of every unknown of a fit, in its own unit, by resampling with the fit's
/// sensitivities. Deterministic by seed. Two things are resampled, because each is blind to
/// something, and their squares add up: blocks of time (noise, and what happens now and then), and
/// regimes, a channel at one level of its place's speed and load, less the noise that is in both: a
/// law of another shape pulls one way where things are slow and another way where they are fast,
/// and every block of time holds both. Parameters of effects have an allowance besides: the true
/// law may do a twentieth of its effect otherwise, in the direction that moves them most. Where
/// ordinary parameters imitate nearly all of an effect, that is much.
std::vector<std::pair<double, double>> bootstrap_intervals(
    const Fitted& fitted, const Experiments& experiments,
    const std::vector<MeasuredVariable>& variables, std::uint64_t seed);

}  // namespace discovery
}  // namespace anthrob
