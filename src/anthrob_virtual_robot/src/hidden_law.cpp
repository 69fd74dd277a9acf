#include "hidden_law.h"

#include <stdexcept>

namespace anthrob::virtual_robot {

const HiddenLaw& hidden_law(const std::string& id) {
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& law : *laws) {
      if (law.id == id) return law;
    }
  }
  throw std::invalid_argument(id + ": no such law; --list shows all");
}

Hidden scaled(const Hidden& hidden, double factor) {
  const HiddenLaw& law = hidden_law(hidden.id);
  Hidden result = hidden;
  for (const std::string& size : law.sizes) {
    double& value = result.parameters.at(size);
    value = law.neutral + factor * (value - law.neutral);
  }
  return result;
}

void build_in(const Hidden& hidden, Draft* draft) {
  hidden_law(hidden.id).build(hidden, draft);
}

}  // namespace anthrob::virtual_robot
