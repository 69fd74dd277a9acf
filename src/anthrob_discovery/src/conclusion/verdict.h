#pragma once

#include "conclusion/answer.h"
#include "options/options.h"

namespace anthrob {
namespace discovery {

/// @param any_effect whether one was named
Verdict verdict_on(bool any_effect, const Diagnosis& diagnosis, const ConclusionOptions& options);

/// The effect with its probability and those of its rivals lowered by trust_in(): what is left
/// suggests that the true law is another one.
FoundEffect trusted(FoundEffect effect, const TrustOptions& options);

/// What is left after all, in numbers and words. Dependences of channels without a certain gap are
/// left out.
Remaining remaining_of(const Diagnosis& diagnosis, const Options& options);

}  // namespace discovery
}  // namespace anthrob
