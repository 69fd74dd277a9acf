#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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
  double before = 0.0;                ///< excess of the channel it shows in
};

/// The channel of what is held out in which an effect takes away most.
/// @param judge of the residuals   @param without, with it
void note_what_it_shows_in(const Judge& judge, const Eigen::VectorXf& without,
                           const Eigen::VectorXf& with, NamedEffect& effect);

/// Of what the effects were to explain where each of them shows most, what is left.
/// @param first, left residuals held out, without any and with all of them
void measure_what_is_left(const Judge& judge, const Eigen::VectorXf& first,
                          const Eigen::VectorXf& left, std::vector<NamedEffect>& effects);

/// The effect that is least likely to be right, by what it leaves; its rivals count with it, for
/// what cannot be told from others at its place is no wrong answer. @return nullptr if there is
/// none
NamedEffect* least_likely(std::vector<NamedEffect>& effects);
/// Its probability, in that sense.
double likelihood_of(const FoundEffect& effect);

}  // namespace discovery
}  // namespace anthrob
