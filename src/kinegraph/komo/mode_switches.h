#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/komo/motion_problem.h"

namespace kinegraph {

/// A mode that objects change to: from times[0] on, frames[1] hangs below frames[0] by a joint that `mode` says. Modes
/// in which an object moves by itself take it alone, too.
struct SwitchSpec {
  std::vector<double> times;  ///< [from, to]; `to` where a next switch takes over; negative: it holds to the end
  SwitchMode mode;
  std::vector<std::string> frames;
  bool first = true;  ///< keeps the motion continuous at the beginning, too
};

/// Changes the structure of the path, and adds what keeps the motion continuous where the mode begins and ends. Throws
/// FrameNotFound and ValueError; leaves a warning if it begins beyond the end.
void addModeSwitch(MotionProblem& motion, const SwitchSpec& demand);

/// From `time` on, `object` sits at `parent`, without a joint. `no_jump`: it does not jump there.
void addRigidSwitch(MotionProblem& motion, double time, const std::string& parent, const std::string& object,
                    bool no_jump);

/// A frame in all slices, with a joint whose dofs are the same in all of them (`stable`) or one set per slice.
struct FrameSpec {
  std::string name;
  std::string parent{};  ///< empty: the world
  JointType type;        ///< none: it does not move
  bool stable;
  std::string origin{};  ///< it moves relative to where this frame is now, relative to the parent; empty: to the parent
  std::optional<Pose> origin_pose{};  ///< world pose to take in place of the origin's present one
};

/// Throws FrameNotFound, and ValueError for a name that is there already and for joints that cannot be added.
void addFrameDof(Path& path, const FrameSpec& demand);

}  // namespace kinegraph
