#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph::inline komo_internal {

/// Specification of a mode switch: from times[0] on, frames[1] is attached to frames[0] by the joint of `mode`. Modes
/// in which an object moves freely also accept the object alone.
struct SwitchSpec {
  std::vector<double> times;  ///< [from, to]; `to` is the time of the next switch, negative for the end of the path
  SwitchMode mode;
  std::vector<std::string> frames;
  bool first = true;  ///< also requires continuity of the motion at the beginning
};

/// Changes the kinematic structure of the path, and adds objectives that make the motion continuous at the beginning
/// and end of the mode. Throws FrameNotFound and ValueError. Adds a warning if the mode begins after the end of the
/// path.
void addModeSwitch(MotionProblem& motion, const SwitchSpec& spec);

/// Attaches `object` rigidly to `parent` from `time` on. `no_jump` requires that its pose is continuous.
void addRigidSwitch(MotionProblem& motion, double time, const std::string& parent, const std::string& object,
                    bool no_jump);

/// Specification of a frame in all slices, with a joint whose dofs are either shared by all slices (`stable`) or
/// separate.
struct FrameSpec {
  std::string name;
  std::string parent{};  ///< empty for the world
  JointType type;        ///< none for a fixed frame
  bool stable;
  std::string origin{};  ///< frame whose present pose, relative to the parent, is the origin of the joint; empty for
                         ///< the parent's pose
  std::optional<Pose> origin_pose{};  ///< world pose that replaces the present one of the origin
};

/// Adds a frame. Throws FrameNotFound, and ValueError for an existing name and for unsupported joints.
void addFrameDof(Path& path, const FrameSpec& spec);

}  // namespace kinegraph::inline komo_internal
