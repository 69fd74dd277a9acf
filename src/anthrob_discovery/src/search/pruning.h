#pragma once

#include "question/observer.h"
#include "search/working_model.h"

namespace anthrob {
namespace discovery {

/// Takes effects out of the model again, and undoes what they cost channels that have nothing to do
/// with them (steps 8 and 10 of docs/discovery_method.md).
class Pruning {
 public:
  /// All must outlive the object.
  Pruning(const Hypotheses& hypotheses, const Observer& observer, WorkingModel& model)
      : hypotheses_(hypotheses), observer_(observer), model_(model) {}

  /// Drops effects that are not needed beside those that were named later (BackwardElimination).
  /// @param newest the effect that has just earned its place and is not checked; the number of
  /// effects: check all
  void drop_superfluous(std::size_t newest);
  /// Drops effects, one after another, whose law is hardly the right one (least_of_improbable()):
  /// it explains too little, its shape ends at a limit, or it makes a channel too much worse. Such
  /// a law may do what another one should, and is not named again.
  /// @return whether any was dropped
  bool drop_improbable();
  /// Fits the model so that the effects cost no channel anything, as far as possible. Undone if
  /// that spoils a channel where none was spoilt.
  void spare_channels_that_pay();

 private:
  Tested spared() const;
  void begin_again();

  const Hypotheses& hypotheses_;
  const Observer& observer_;
  WorkingModel& model_;
};

}  // namespace discovery
}  // namespace anthrob
