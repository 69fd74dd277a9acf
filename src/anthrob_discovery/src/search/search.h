#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "baseline/baseline.h"
#include "hypotheses/screening.h"
#include "question/observer.h"
#include "search/law_elsewhere.h"
#include "search/pruning.h"
#include "search/search_result.h"
#include "search/working_model.h"

namespace anthrob {
namespace discovery {

/// Adds effects to the recalibrated model, one in each round, until no further one earns its place,
/// and takes out again what is not needed or improbable (steps 4 to 8 of docs/discovery_method.md).
/// @param scores of the screening for the baseline
SearchResult search(const Hypotheses& hypotheses, const Baseline& baseline, Screening& screening,
                    std::vector<Score> scores, int most_effects, const Observer& observer);

/// Adds effects to a model, one in each round.
class Search {
 public:
  /// All must outlive the object.
  Search(const Hypotheses& hypotheses, const Observer& observer, WorkingModel& model,
         Screening& screening, Pruning& pruning, int most_effects)
      : hypotheses_(hypotheses),
        observer_(observer),
        model_(model),
        screening_(screening),
        pruning_(pruning),
        most_effects_(most_effects) {}

  /// Effect after effect, until none earns its place and no named law should say more.
  /// @param scores of the model as it is; empty: to be found
  void run(std::vector<Score> scores);

 private:
  const SearchOptions& options() const { return hypotheses_.options.search; }
  void add_effects(std::vector<Score> scores);
  /// Replaces a named law by one that says more at its place, if that one did better in the round
  /// in which the simple one was named, and clearly does now.
  /// @return whether a law was replaced, so that the search should go on
  bool fill_out();
  std::vector<Score> new_scores();
  void comment_on(const ShortList& list) const;
  void favour_what_is_named() const;
  bool base_moves_on(const ShortList& list);
  bool earns_its_place(const ShortList& list);
  /// The first of a list did not earn its place. @return whether another list is worthwhile
  bool goes_on_elsewhere(const ShortList& list);
  void accept(ShortList& list);
  /// If a law of the list is named elsewhere already: names it at all its places at once, where
  /// that does better than the first of the list. @return whether it does
  bool accept_elsewhere(const ShortList& list);
  void name_parts(const LawElsewhere::Everywhere& all, double probability);
  void unite();
  std::optional<Contest> first_contest(const ShortList& list) const;
  /// What held-out recordings say of the candidates of a list [nat].
  using Evidence = std::map<std::size_t, double>;
  static Evidence evidence_of(const ShortList& list);
  std::optional<std::size_t> fuller_than(std::size_t simple, const Evidence& evidence) const;

  const Hypotheses& hypotheses_;
  const Observer& observer_;
  WorkingModel& model_;
  Screening& screening_;
  Pruning& pruning_;
  int most_effects_;
  int rounds_ = 0;
};

}  // namespace discovery
}  // namespace anthrob
