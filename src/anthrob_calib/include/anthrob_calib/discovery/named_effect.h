#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "anthrob_calib/discovery/candidate.h"
#include "anthrob_calib/discovery/discovery.h"
#include "anthrob_calib/discovery/judge.h"

namespace anthrob {
namespace discovery {

/// An effect in the model, and what the search remembers of how it came in.
struct NamedEffect {
  FoundEffect found;
  std::size_t candidate = 0;
  double gained = 0.0;                ///< of the cost
  std::optional<std::size_t> fuller;  ///< a law that says more there, and did better in its round
  double before = 0.0;  ///< excess of the channel it shows in, then; 0: not to be counted
};

/// The channel of what is held out in which an effect takes away most.
/// @param judge of the residuals   @param without, with it
void note_what_it_shows_in(const Judge& judge, const Eigen::VectorXf& without,
                           const Eigen::VectorXf& with, NamedEffect& effect);

/// Of what the effects were to explain where each of them shows most, what is left: all, where one
/// shows nowhere.
/// @param first, left residuals held out, without any and with all of them
void measure_what_is_left(const Judge& judge, const Eigen::VectorXf& first,
                          const Eigen::VectorXf& left, std::vector<NamedEffect>& effects);

/// A fitted parameter that is no size, of either sign, and ends where its range does; empty: none.
std::string limit_of(const Candidate& candidate, const EffectInstance& instance);

/// Of effects that are improbable by what they leave or by where their shape has ended, the one
/// that gained least; null: none is. Rivals count with a name: what cannot be told from others is
/// no wrong answer.
const NamedEffect* least_of_improbable(const std::vector<NamedEffect>& effects);

}  // namespace discovery
}  // namespace anthrob
