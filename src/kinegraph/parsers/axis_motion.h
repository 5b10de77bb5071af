#pragma once

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The motion of a joint about or along an axis, in the terms of a scene.
struct AxisMotion {
  const char* type;                            ///< of the joint
  double scale = 1.;                           ///< 1 or -1
  Quaterniond turn = Quaterniond::Identity();  ///< of the joint frame, so that its axis is a coordinate axis
};

/// hingeX, hingeY, hingeZ, or hinge, which has any axis. `axis` has unit length.
AxisMotion turningAbout(const Vector3d& axis);

/// transX, transY, transZ with a sign; for other axes transX in a frame that is turned.
AxisMotion slidingAlong(const Vector3d& axis);

}  // namespace kinegraph
