#pragma once

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/scene/hand_fingers.h"

namespace kinegraph::inline robot_internal {

/// A gripper of a scene: an inactive joint, and the joints that mimic it (the fingers).
struct SceneGripper {
  GripperInfo info;                  ///< named after a frame of its link that ends in "gripper", else after the joint
  std::string joint;                 ///< the frame of the joint
  HandFingers opening;               ///< the opening in m, whatever moves the fingers
  std::vector<std::string> fingers;  ///< the frames of the joint and of those that mimic it
};

/// Returns all grippers, in the order of their joints' frames.
std::vector<SceneGripper> findGrippers(const Config& config);

/// Copies the state of all joints, active or not, and the poses of free and attached frames from one configuration to
/// another, by name. Frames that only one of them has are skipped.
void copyMotion(const Config& from, Config& to);

/// Copies the poses of named frames without a joint relative to their parents, if both configurations have them.
void copyRelativePoses(const Config& from, Config& to, const std::vector<std::string>& names);

/// Copies the frames of `from` whose names are new to `to`, except for maps of cells. Their joints are inactive: q of
/// `to` is that of a robot. Returns their number.
int copyNewFrames(const Config& from, Config& to);

/// Returns the first frame of the link: the topmost one without a joint in between.
Frame headOfLink(const Frame& frame);

}  // namespace kinegraph::inline robot_internal
