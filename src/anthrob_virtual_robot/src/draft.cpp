#include "draft.h"

#include <numeric>
#include <sstream>
#include <stdexcept>

namespace anthrob::virtual_robot {

std::size_t Draft::muscle(const std::string& name) const {
  for (std::size_t i = 0; i < arm.muscles.size(); ++i) {
    if (arm.muscles[i].name == name) return i;
  }
  throw std::invalid_argument(name + ": no such muscle");
}

std::vector<std::size_t> Draft::muscles(const std::string& place) const {
  if (place != "all") return {muscle(words(place).front())};
  std::vector<std::size_t> all(arm.muscles.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<std::string> words(const std::string& place) {
  std::istringstream stream(place);
  std::vector<std::string> result;
  for (std::string word; std::getline(stream, word, '/');) result.push_back(word);
  return result;
}

}  // namespace anthrob::virtual_robot
