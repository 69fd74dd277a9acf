// What virtual robots hide can be said in the words of the effect catalogue: its ids, places,
// parameters, and within its bounds. Else discovery would be asked for what it cannot answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "anthrob_reference/arm.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/model/robot_model.h"
#include "hidden_law.h"

namespace anthrob {
namespace {

TEST(HiddenSizes, CanBeSaidInTheCataloguesWords) {
  const std::string model_file = std::string(ANTHROB_CONFIG_DIR) + "/anthrob/model_I.yaml";
  const auto robot = load_robot_model(model_file);
  const auto arm = reference::Arm::load(model_file);
  virtual_robot::Random random(3);
  for (const virtual_robot::HiddenLaw& law : virtual_robot::catalogue_laws()) {
    const Effect* const effect = find_effect(law.id);
    ASSERT_NE(effect, nullptr) << law.id;
    const auto places = effect->places(*robot);
    for (const std::string& place : law.places(arm)) {
      EXPECT_EQ(std::count(places.begin(), places.end(), place), 1) << law.id << " @ " << place;
      const auto known = effect->parameters_at(*robot, place);
      const virtual_robot::Hidden typical{law.id, place, law.draw(arm, place, &random)};
      for (const double factor : {law.least, 1.0, law.most}) {
        for (const auto& [name, value] : scaled(typical, factor).parameters) {
          const auto found = std::find_if(known.begin(), known.end(),
                                          [&, n = name](const auto& p) { return p.name == n; });
          if (found == known.end()) continue;  // a hidden law may have shapes of its own
          EXPECT_TRUE(found->bounds.contains(value))
              << law.id << " @ " << place << ": " << name << " " << value;
        }
      }
      for (const std::string& size : law.sizes) {
        EXPECT_TRUE(
            std::any_of(known.begin(), known.end(), [&](const auto& p) { return p.name == size; }))
            << law.id << " @ " << place << ": " << size;
      }
    }
  }
}

}  // namespace
}  // namespace anthrob
