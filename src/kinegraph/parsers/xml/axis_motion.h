#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph::inline parsers_internal {

/// The motion of a joint about or along an axis, as a joint type of a scene.
struct AxisMotion {
  const char* type;   ///< joint type
  double scale = 1.;  ///< 1 or -1
  Quaterniond rotation =
      Quaterniond::Identity();  ///< of the joint frame: aligns its coordinate axis with the joint axis
};

/// Returns hingeX, hingeY, hingeZ, or hinge for any other axis. `axis` has unit length.
AxisMotion rotationAbout(const Vector3d& axis);

/// Returns transX, transY, transZ with a sign; for other axes transX in a rotated frame.
AxisMotion translationAlong(const Vector3d& axis);

}  // namespace kinegraph::inline parsers_internal
