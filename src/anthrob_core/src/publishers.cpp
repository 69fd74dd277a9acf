#include "anthrob_core/publishers.h"

namespace anthrob {

void Publishers::add(const std::vector<std::string>& names, const std::string& node) {
  if (conflict_ || node.empty()) return;
  for (const std::string& name : names) {
    Past& past = past_.try_emplace(name, Past{node, {}}).first->second;
    if (past.last == node) continue;
    if (past.before.count(node)) {
      conflict_ = "two nodes publish " + name + ": " + past.last + " and " + node;
      return;
    }
    past.before.insert(past.last);
    past.last = node;
  }
}

}  // namespace anthrob
