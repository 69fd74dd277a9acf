#pragma once

#include <functional>

namespace anthrob::virtual_robot {

/// A factor for which `change` is near `target`, within [least, most]; `change` grows with it. A
/// secant on logarithms between the nearest on both sides, at most `tries` evaluations; of those the
/// nearest.
double dose(const std::function<double(double)>& change, double target, double least, double most,
            int tries = 6);

}  // namespace anthrob::virtual_robot
