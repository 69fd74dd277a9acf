#include "anthrob_driver/emulation/emulator.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace driver {
namespace {

TEST(Emulator, BelongsOnAVirtualBus) {
  for (const char* const interface : {"can0", "slcan0", "xvcan0", ""}) {
    EXPECT_THROW(refuse_physical_bus(interface, false), BadInput) << interface;
    EXPECT_NO_THROW(refuse_physical_bus(interface, true)) << interface;
  }
  EXPECT_NO_THROW(refuse_physical_bus("vcan0", false));
  EXPECT_NO_THROW(refuse_physical_bus("vcan_robot", false));
}

/// What anthrob_can_check says, on a machine without these interfaces; its status last.
std::string check(const std::string& arguments) {
  FILE* const pipe =
      ::popen((std::string(ANTHROB_CAN_CHECK) +
               " --hardware " ANTHROB_CONFIG_DIR "/anthrob/hardware.yaml --seconds 0.1 " +
               arguments + " 2>&1")
                  .c_str(),
              "r");
  std::array<char, 512> line;
  std::string said;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) said += line.data();
  return said + "status " + std::to_string(WEXITSTATUS(::pclose(pipe)));
}

TEST(Emulator, OfTheBusCheckDoesNotComeBesideARobot) {
  const std::string refused = check("--emulate --can nocan7");
  EXPECT_NE(refused.find("--can: nocan7: expected vcan0 or the like"), std::string::npos)
      << refused;
  EXPECT_NE(refused.find("status 2"), std::string::npos) << refused;
  // Then it is the interface that is not there.
  for (const char* const others :
       {"--emulate --can vcan_none", "--emulate --physical --can nocan7", "--can nocan7"}) {
    EXPECT_EQ(check(others).find("or the like"), std::string::npos) << check(others);
  }
}

}  // namespace
}  // namespace driver
}  // namespace anthrob
