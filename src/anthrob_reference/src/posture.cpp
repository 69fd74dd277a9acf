#include "anthrob_reference/posture.h"

#include <Eigen/Geometry>

namespace anthrob::reference {

Vector4 Posture::generalized(Body body, const Eigen::Vector3d& force,
                             const Eigen::Vector3d& moment) const {
  Vector4 result = Vector4::Zero();
  if (body == Body::kBase) return result;
  result.head<3>() = moment;
  if (body == Body::kForearm) {
    result(3) = elbow_axis.dot(moment - elbow_centre.cross(force));
  }
  return result;
}

}  // namespace anthrob::reference
