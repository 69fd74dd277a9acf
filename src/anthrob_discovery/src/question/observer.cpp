#include "question/observer.h"

#include "experiment/evaluator.h"

namespace anthrob {
namespace discovery {

void Observer::stage(const std::string& what) const {
  if (progress && !progress(what)) throw Interrupted();
}

void Observer::say(const std::string& line) const {
  if (comment) comment(line);
}

void Observer::favour(const std::string& names) const {
  if (candidate) candidate(names);
}

}  // namespace discovery
}  // namespace anthrob
