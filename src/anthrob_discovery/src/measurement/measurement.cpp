#include "measurement/measurement.h"

#include "measurement/column_correction.h"
#include "measurement/hold_correction.h"
#include "measurement/stamp_correction.h"

namespace anthrob {
namespace discovery {

Description describe(const Evaluator& evaluator, const Question& question) {
  Description description;
  description.question = question;
  correct_columns(*evaluator.model(), description);
  correct_holds(*evaluator.model(), description);
  correct_controller_stamps(*evaluator.model(), evaluator.description().config(), description);
  return description;
}

}  // namespace discovery
}  // namespace anthrob
