#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// Power of two, at or below a share of the noise of bins, to which their differences may be
/// rounded so that they take little space. The noise is that of rows, from their third differences,
/// which motions make larger, over the root of the rows in a bin. 0 if there is none.
double rounding_of(const std::vector<double>& rows, double rows_per_bin, double share);

/// Rounds to multiples of Channel::rounding.
/// @param differences of the experiment, from its first bin on
void round_differences(const Experiment& experiment, float* differences);

/// Bytes of packed differences.
using Packed = Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>;

/// Packs numbers bit for bit (but for the sign of 0), in a byte or less each where they are rounded
/// and close to a reference. In each piece of them, all are multiples of a power of two. Those of
/// the reference are taken off, and what is left is compressed as its change from number to number.
/// @param reference of the same length, or empty
Packed packed(const Eigen::VectorXf& numbers, const Eigen::VectorXf& reference);
/// @param reference that they were packed with
Eigen::VectorXf unpacked(const Packed& bytes, const Eigen::VectorXf& reference);

}  // namespace discovery
}  // namespace anthrob
