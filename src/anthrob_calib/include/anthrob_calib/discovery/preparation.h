#pragma once

#include "anthrob_calib/discovery/discovery.h"

namespace anthrob {
namespace discovery {

/// Recordings as experiments, with the same bins.
struct Laboratory {
  Experiments train, test, repeats;
};

/// Lays out bins and refuses recordings that cannot answer, saying what is missing.
/// @throws BadInput with one line
Laboratory prepare(const Evaluator& evaluator, const Question& question);

}  // namespace discovery
}  // namespace anthrob
