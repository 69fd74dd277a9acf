#pragma once

#include <QImage>

#include "display/theme.h"

namespace anthrob {

/// What the colours and thicknesses of tendons mean.
/// @param full_force where the scale ends [N]
QImage force_legend(double full_force, const Theme& theme);

}  // namespace anthrob
