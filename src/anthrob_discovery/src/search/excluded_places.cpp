#include "search/excluded_places.h"

#include <algorithm>

namespace anthrob {
namespace discovery {

bool ExcludedPlaces::exclude(std::size_t first, const std::vector<std::size_t>& accepted) {
  const std::string place = candidates_[first].owner();
  const bool is_left = std::any_of(accepted.begin(), accepted.end(), [&](std::size_t candidate) {
    return candidates_[candidate].owner() == place;
  });
  return is_left && places_.insert(place).second;
}

std::vector<Score> ExcludedPlaces::filter(std::vector<Score> scores) const {
  scores.erase(std::remove_if(scores.begin(), scores.end(),
                              [&](const Score& score) {
                                return places_.count(candidates_[score.candidate].owner()) > 0;
                              }),
               scores.end());
  return scores;
}

}  // namespace discovery
}  // namespace anthrob
