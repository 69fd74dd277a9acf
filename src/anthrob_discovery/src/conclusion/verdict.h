#pragma once

#include "conclusion/answer.h"

namespace anthrob {
namespace discovery {

/// @param any_effect whether one was named
Verdict verdict_on(bool any_effect, const Diagnosis& diagnosis);

/// The effect with its probability and those of its rivals lowered by trust_in(): what is left
/// suggests that the true law is another one.
FoundEffect trusted(FoundEffect effect);

/// What is left after all, in numbers and words. Dependences of channels without a certain gap are
/// left out.
Remaining remaining_of(const Diagnosis& diagnosis);

}  // namespace discovery
}  // namespace anthrob
