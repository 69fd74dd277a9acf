#include "question/question.h"

namespace anthrob {
namespace discovery {

std::vector<std::string> remarks_on_ordinary_parameters(const Question& question) {
  if (!question.nuisances.empty()) return {};
  const std::string why =
      question.calibration_file.empty()
          ? question.model_file + ": no calibration.yaml beside it or what it extends"
          : question.calibration_file + ": lists no parameters";
  return {why +
          ", so no ordinary parameters are fitted; a wrong length or radius may be reported "
          "as an effect"};
}

}  // namespace discovery
}  // namespace anthrob
