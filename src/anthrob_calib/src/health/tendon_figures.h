#pragma once

#include <string>
#include <vector>

#include "anthrob_recording/dataset.h"
#include "health/protocol.h"

namespace anthrob {
namespace health {

/// What a test measures of a tendon.
enum class Quantity {
  kForceOffset,  ///< reading of the force sensor while the tendon is slack [N]
  kStiffness,    ///< dF/dx of spring and tendon at the middle tension [N/m]
  kZero,         ///< wound length at the middle tension, less that of the model [m]
  kHysteresis,   ///< half of the forces' difference between tightening and slackening [N]
  kFriction,     ///< half of the currents' difference at the same force [A]
  kCurrentGain,  ///< current per force [A/N]
  kResistance,   ///< voltage per current of the resting motor [ohm]
  kCreep,        ///< share of the force that is lost in the hold [1]
};
constexpr int kQuantities = 8;
const char* name_of(Quantity quantity);
const char* unit_of(Quantity quantity);

struct Figure {
  Quantity quantity;
  double value, low, high;  ///< 95 %
};

struct TendonFigures {
  std::string muscle;
  std::vector<Figure> figures;       ///< those that the recording tells
  std::vector<std::string> remarks;  ///< which it does not tell, and why
};

/// @param recording of the test: commands from its beginning on, and what was measured
std::vector<TendonFigures> measure(const TestProtocol& protocol, const Dataset& recording);

}  // namespace health
}  // namespace anthrob
