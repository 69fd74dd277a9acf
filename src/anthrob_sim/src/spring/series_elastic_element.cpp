#include "anthrob_sim/spring/series_elastic_element.h"

#include <map>

#include "spring/spring_damper.h"
#include "spring/wiechert.h"
#include "spring/zener.h"

namespace anthrob {

std::shared_ptr<const SeriesElasticElement> make_series_elastic_element(const ConfigNode& node,
                                                                        int quantity, double step) {
  using Factory = std::shared_ptr<const SeriesElasticElement> (*)(const ConfigNode&, int, double);
  // A new element: one file, one line here.
  static const std::map<std::string, Factory> kFactories = {
      {"spring_damper", &SpringDamper::load},
      {"wiechert", &Wiechert::load},
      {"zener", &Zener::load},
  };
  const auto it = kFactories.find(node.text("type"));
  if (it == kFactories.end()) {
    std::string known;
    for (const auto& entry : kFactories) known += (known.empty() ? "" : ", ") + entry.first;
    node.at("type").fail_expected("one of: " + known);
  }
  return it->second(node, quantity, step);
}

}  // namespace anthrob
