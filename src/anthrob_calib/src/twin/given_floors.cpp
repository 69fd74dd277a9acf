#include "twin/given_floors.h"

#include <algorithm>

#include "anthrob_core/config_node.h"

namespace anthrob {
namespace twin {

Floors load_floors(const std::string& file, const Channels& channels) {
  const ConfigNode node = ConfigNode::load(file);
  Floors floors;
  for (const auto& [name, value] : node.at("floors").entries()) {
    const auto channel = std::find_if(channels.all.begin(), channels.all.end(),
                                      [&, key = name](const Channel& c) { return c.name == key; });
    if (channel == channels.all.end()) value.fail("the model has no such channel");
    floors[name] = value.as_number(Bounds::positive(), channel->unit);
  }
  node.refuse_unknown_keys();
  return floors;
}

}  // namespace twin
}  // namespace anthrob
