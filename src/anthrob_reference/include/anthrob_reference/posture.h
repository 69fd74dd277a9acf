#pragma once

#include <Eigen/Core>
#include <array>

#include "anthrob_reference/parameters.h"

namespace anthrob::reference {

/// Generalised velocity (humerus in its own axes, then elbow) [rad/s] or generalised force [Nm].
using Vector4 = Eigen::Matrix<double, 4, 1>;
using Matrix4 = Eigen::Matrix<double, 4, 4>;

/// Where the bodies are, seen from the humerus: origin at the shoulder centre S, humerus axes H.
struct Posture {
  struct Frame {                                         // X: the body
    Eigen::Matrix3d R_HX = Eigen::Matrix3d::Identity();  ///< body axes in H
    Eigen::Vector3d p_SX = Eigen::Vector3d::Zero();      ///< body origin from S, in H [m]
  };
  std::array<Frame, 3> frames;                             ///< indexed by Body
  Eigen::Vector3d elbow_axis = Eigen::Vector3d::Zero();    ///< unit, in H
  Eigen::Vector3d elbow_centre = Eigen::Vector3d::Zero();  ///< from S, in H [m]

  const Frame& frame(Body body) const { return frames[static_cast<std::size_t>(body)]; }

  /// A point of the body, from S, in H [m].
  Eigen::Vector3d point(Body body, const Eigen::Vector3d& p_body) const {
    return frame(body).R_HX * p_body + frame(body).p_SX;
  }

  /// Generalised force of a wrench on the body: force [N] and its moment about S [Nm], in H.
  Vector4 generalized(Body body, const Eigen::Vector3d& force, const Eigen::Vector3d& moment) const;
};

}  // namespace anthrob::reference
