#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_sim/simulation.h"
#include "twin/twins.h"

namespace anthrob {
namespace twin {

/// A command for one muscle, from now on.
struct Order {
  int muscle = 0;
  ecu::Mode mode = ecu::Mode::kVoltage;
  double reference = 0.0;
};

/// What is to be predicted.
struct Outlook {
  std::vector<Order> orders;  ///< muscles that are not named keep what they have
  bool enable = false;        ///< as if all units were enabled now
  double duration = 1.0;      ///< [s]
  double rate = 0.0;          ///< [Hz] at which what happens is looked at; 0: only at the end
};

/// A limit that the robot would cross.
struct Crossing {
  std::string place, quantity, unit;  ///< "elbow", "position", "rad"
  double value = 0.0, limit = 0.0;    ///< [unit]; the largest value that comes
  double time = 0.0;                  ///< [s] from now, when it is crossed first

  /// "elbow: position of 1.9 rad, beyond 1.8 rad from 0.4 s on"
  std::string text() const;
};

/// The robot as it was measured last, free to move from there, under the commands that it follows.
/// @throws BadInput if the twins have lost the robot
std::unique_ptr<Simulation> present(const Twins& twins);

/// Runs a simulation ahead. Limits are the stops of joints, and the largest forces that muscles may
/// be commanded to have.
/// @param see called at each moment that is looked at, with the time from the start [s]
/// @return limits that are crossed, by the time when they are
/// @throws BadInput for an order that the muscle cannot follow; NumericalFailure
std::vector<Crossing> run_ahead(Simulation& sim, const Outlook& outlook,
                                const std::function<void(double)>& see);

}  // namespace twin
}  // namespace anthrob
