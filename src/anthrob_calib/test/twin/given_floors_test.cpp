#include "twin/given_floors.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "anthrob_core/errors.h"
#include "twin/moving_robot.h"

namespace anthrob {
namespace twin {
namespace {

Floors floors_of(const std::string& text) {
  const auto model = load_robot_model(rig_file());
  const std::string file = std::filesystem::temp_directory_path() /
                           ("given_floors_" + std::to_string(::getpid()) + ".yaml");
  std::ofstream(file) << text;
  return load_floors(file, Channels(*model, TwinOptions{}));
}

std::string refusal_of(const std::string& text) {
  try {
    floors_of(text);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(GivenFloors, AreRead) {
  EXPECT_EQ(floors_of("floors: {flexor/force: 0.2, hinge/position: 0.001}\n"),
            (Floors{{"flexor/force", 0.2}, {"hinge/position", 0.001}}));
}

TEST(GivenFloors, AreRefused) {
  EXPECT_NE(refusal_of("floors: {biceps/force: 0.2}\n").find("biceps/force"), std::string::npos);
  EXPECT_NE(refusal_of("floors: {flexor/force: 0}\n").find("expected"), std::string::npos);
  EXPECT_NE(refusal_of("floors: {}\nfloor: 1\n").find("floor"), std::string::npos);
  EXPECT_NE(refusal_of("floors: {flexor/force: little}\n").find("little"), std::string::npos);
}

}  // namespace
}  // namespace twin
}  // namespace anthrob
