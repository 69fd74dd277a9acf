#include "anthrob_sim/recording/quantities.h"

#include <set>

namespace anthrob {

bool is_muscle_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"mode",    "reference", "position", "velocity",
                                             "current", "voltage",   "force",    "ecu_state"};
  return kAll.count(quantity) > 0;
}

bool is_ball_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"w", "x", "y", "z", "wx", "wy", "wz"};
  return kAll.count(quantity) > 0;
}

bool is_joint_quantity(const std::string& quantity) {
  static const std::set<std::string> kAll = {"position", "velocity", "effort", "load"};
  return kAll.count(quantity) > 0;
}

}  // namespace anthrob
