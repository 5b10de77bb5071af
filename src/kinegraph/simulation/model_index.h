#pragma once

#include <utility>
#include <vector>

#include "kinegraph/simulation/model_shapes.h"
#include "kinegraph/simulation/scene_model.h"

namespace kinegraph::inline simulation_internal {

/// The parts of a model before MuJoCo compiles it.
struct ModelParts {
  struct MadeJoint {
    const FrameData* frame;
    std::vector<std::pair<MotionKind, mjsJoint*>> steps;  ///< null for a step without motion
  };
  std::vector<mjsBody*> bodies;  ///< in the order of SceneBodies::bodies
  std::vector<MadeJoint> joints;
  std::vector<std::vector<const FrameData*>> grippers;  ///< each a joint and its followers
  std::vector<mjsSensor*> sensors;                      ///< pairs of force and torque sensors, then the accelerometers

  const MadeJoint& joint(const FrameData& frame) const;

  /// Returns the frames of the joints that mimic the joint of `source`.
  std::vector<const FrameData*> followersOf(const FrameData& source) const;
};

/// Returns whether the joint's motion is one number, along or about an axis.
bool isScalar(MotionKind kind);

/// Returns whether it is a single inactive joint, as finger joints are. With followers it forms a gripper.
bool isFingerJoint(const FrameData& frame);

/// Returns the motion of a follower per motion of the joint that it mimics.
double motionRatio(const FrameData& follower, const FrameData& source);

/// Fills in the compiled model's ids and addresses of the scene's bodies, geoms, joints, servos, grippers and sensors.
void indexModel(const ModelParts& parts, const std::vector<ModelShapes::Geom>& geoms, const KinematicModel& kinematics,
                SceneModel& model);

}  // namespace kinegraph::inline simulation_internal
