#include "admission/shared_channels.h"

#include <algorithm>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace discovery {

namespace {

/// Each once: an orientation is three channels of one name.
std::vector<std::string> names_of(const Experiments& experiments) {
  std::vector<std::string> names;
  for (const Channel& channel : channels_of(experiments)) {
    if (std::find(names.begin(), names.end(), channel.name()) == names.end()) {
      names.push_back(channel.name());
    }
  }
  return names;
}

/// "a, b, c, ..."
std::string some_of(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(most, names.size()); ++i) {
    text += (i == 0 ? "" : ", ") + names[i];
  }
  return text + (names.size() > most ? ", ..." : "");
}

}  // namespace

std::vector<std::string> remarks_on_channels(const Experiments& train, const Experiments& test,
                                             const AdmissionOptions& options) {
  const std::vector<std::string> learned = names_of(train), held_out = names_of(test);
  std::vector<std::string> remarks;
  const auto remark = [&](const std::vector<std::string>& names,
                          const std::vector<std::string>& others, const std::string& side) {
    for (const std::string& name : names) {
      if (std::find(others.begin(), others.end(), name) != others.end()) continue;
      remarks.push_back(name + ": measured in the " + side +
                        " recordings only, so it is not judged");
    }
  };
  remark(learned, held_out, "--train");
  remark(held_out, learned, "--test");
  if (remarks.size() < learned.size() + held_out.size()) return remarks;
  throw BadInput(test.front()->name() +
                 ": the held-out recordings measure none of the channels of the training "
                 "recordings (" +
                 some_of(learned, options.names_listed) + "), only others (" +
                 some_of(held_out, options.names_listed) +
                 "); expected the same measured columns in --train and --test");
}

}  // namespace discovery
}  // namespace anthrob
