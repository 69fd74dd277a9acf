#pragma once

#include <functional>

namespace anthrob::virtual_robot {

/// Finds a factor within [least, most] for which `change` is near `target`; `change` must grow with
/// it. Uses secants on logarithms between the nearest values on both sides, and returns the best of
/// at most `tries` evaluations.
double dose(const std::function<double(double)>& change, double target, double least, double most,
            int tries = 6);

}  // namespace anthrob::virtual_robot
