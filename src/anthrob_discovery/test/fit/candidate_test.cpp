#include "fit/candidate.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "anthrob_core/errors.h"
#include "config.h"
#include "discover.h"

namespace anthrob {
namespace discovery {
namespace {

TEST(ListCandidates, EveryDoseCanBeBuilt) {
  const std::string model = kConfig + "/anthrob/model_I.yaml";
  const Evaluator evaluator(model, ordinary_parameters(model, ""), 0.001, 1);
  const std::vector<Candidate> candidates = list_candidates(evaluator, {});
  EXPECT_GT(candidates.size(), 100u);
  for (const Candidate& candidate : candidates) {
    EXPECT_FALSE(candidate.sizes().empty()) << candidate.name();
    for (const EffectParameter* size : candidate.sizes()) {
      Variant variant{evaluator.initial_nuisances()};
      variant.effects = {candidate.dose(*size)};
      EXPECT_NO_THROW(evaluator.build(variant)) << candidate.name() << " " << size->name;
    }
  }
}

TEST(ListCandidates, EffectsThatAreAskedForHaveAPlace) {
  const std::string model = kConfig + "/driven_axis/model_I.yaml";
  const Evaluator evaluator(model, {}, 0.001, 1);
  EXPECT_FALSE(list_candidates(evaluator, {"joint_coulomb"}).empty());
  try {
    list_candidates(evaluator, {"joint_coulomb", "cogging"});
    FAIL() << "not refused";
  } catch (const BadInput& error) {
    EXPECT_NE(std::string(error.what()).find("--effects cogging: "), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace discovery
}  // namespace anthrob
