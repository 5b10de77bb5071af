#pragma once

#include "kinegraph/scene/tree/frame_data.h"

namespace kinegraph::inline robot_internal {

/// Returns whether the robot moves a frame by a joint of its own; the free joint of a base or an object has no motor.
inline bool isRobotJoint(const FrameData& frame) {
  return frame.moves() && frame.joint->active && frame.joint->type != JointType::free;
}

}  // namespace kinegraph::inline robot_internal
