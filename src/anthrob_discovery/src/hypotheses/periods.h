#pragma once

#include <vector>

#include "options/hypotheses.h"

namespace anthrob {
namespace discovery {

/// An effort along a motion, bin by bin.
struct EffortAlongWay {
  std::vector<double> position;   ///< [turns] of a hinge, [m] of a slide
  std::vector<double> velocity;   ///< [turns/s, m/s]
  std::vector<double> effort;     ///< that a model misses [Nm, N]
  std::vector<std::size_t> runs;  ///< where each recording begins
};

/// A term of a Fourier series over the position: effort = sine sin(2 pi n x) + cosine cos(2 pi n
/// x).
struct Period {
  double number = 0.0;  ///< n, repetitions a turn or a metre
  double sine = 0.0, cosine = 0.0;
};

/// Periods with which an effort repeats along the way, the strongest first; empty if it does not.
///
/// Orthogonal matching pursuit: the frequency that takes most of what is left is added, then all
/// are fitted together with what other laws of a motion may do (a constant, slope, speed, its sign,
/// its square, acceleration). Each must predict a share of the effort at times to which it was not
/// fitted (PeriodOptions). Source: Pati, Rezaiifar, Krishnaprasad 1993.
/// @param most that are returned   @param whole whether whole numbers are preferred: of turns
std::vector<Period> find_periods(const EffortAlongWay& data, std::size_t most, bool whole,
                                 const PeriodOptions& options);

}  // namespace discovery
}  // namespace anthrob
