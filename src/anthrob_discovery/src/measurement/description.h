#pragma once

#include <array>
#include <string>
#include <vector>

#include "question/question.h"

namespace anthrob {
namespace discovery {

/// How one kind of channel was taken: late, held, averaged, counted, by another clock or unit.
struct MeasurementProperty {
  std::string channel_kind;    ///< "voltage"
  std::string place;           ///< "all", or where it differs
  std::string what;            ///< delay | tick_phase | hold | average | filter | count | clock ...
  double value = 0.0;          ///< [unit]
  std::array<double, 2> ci95;  ///< [unit]
  std::string unit;
  std::string source;    ///< meta | found | assumed
  std::string law = {};  ///< of `controller`: which of its numbers
};

/// How the recordings were taken, as far as it is known.
using Measurement = std::vector<MeasurementProperty>;

/// What a question's recordings say, and what that means for them.
struct Description {
  Measurement measurement;
  std::vector<std::string> remarks;  ///< a line for each convention that is not the model's
  Question question;                 ///< with recordings as the model's sensors would have them
  bool corrected = false;            ///< whether any recording differs from what was given
};

/// All that discovery looks at: train, test, repeats.
inline std::vector<Dataset*> recordings_of(Question& question) {
  std::vector<Dataset*> recordings;
  for (auto* group : {&question.train, &question.test, &question.repeats}) {
    for (Dataset& recording : *group) recordings.push_back(&recording);
  }
  return recordings;
}

}  // namespace discovery
}  // namespace anthrob
