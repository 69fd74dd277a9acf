#pragma once

namespace anthrob {
namespace driver {

constexpr double kPeriod = 0.005;  ///< [s] of a robot's measurements

}  // namespace driver
}  // namespace anthrob
