#pragma once

#include "kinegraph/robot/robot_driver.h"

namespace kinegraph {

/// A gripper of a scene: a joint that is no part of q and that others mimic, the fingers.
struct SceneGripper {
  GripperInfo info;                  ///< named as the frame in its link whose name ends in "gripper", else as the joint
  std::string joint;                 ///< the frame of the joint
  double opening = 1.;               ///< m of width per unit of the joint's q
  std::vector<std::string> fingers;  ///< the frames of the joint and of those that mimic it
};

/// All grippers, in the order of their joints' frames: the first is gripper 0.
std::vector<SceneGripper> findGrippers(const Config& config);

/// Moves what moves in `from` to the same place in `to`, by names: joints, those that are no part of q as well, and frames
/// that hang on nothing or are attached to something. Frames that only one of them has are left alone.
void copyMotion(const Config& from, Config& to);

/// Gives `to` the frames of `from` whose names it does not have. Returns their number.
int copyNewFrames(const Config& from, Config& to);

/// The frame that a frame is fixed to without any joint, the last one upwards.
Frame headOfLink(const Frame& frame);

}  // namespace kinegraph
