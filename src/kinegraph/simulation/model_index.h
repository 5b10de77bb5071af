#pragma once

#include <utility>
#include <vector>

#include "kinegraph/simulation/model_shapes.h"
#include "kinegraph/simulation/scene_model.h"

namespace kinegraph {

/// What a model is made of, as it is known before MuJoCo compiles it.
struct ModelParts {
  struct MadeJoint {
    const FrameData* frame;
    std::vector<std::pair<MotionKind, mjsJoint*>> steps;  ///< null for a step that does not move
  };
  std::vector<mjsBody*> bodies;  ///< in the order of the scene's
  std::vector<MadeJoint> joints;
  std::vector<std::vector<const FrameData*>> grippers;  ///< a joint, and those that follow it
  std::vector<mjsSensor*> sensors;                      ///< those of forces two by two, then the accelerometers

  const MadeJoint& joint(const FrameData& frame) const;

  /// Frames of the joints that mimic that of `source`.
  std::vector<const FrameData*> followersOf(const FrameData& source) const;
};

/// Is the joint's motion one number, along or about an axis?
bool isScalar(MotionKind kind);

/// Is it a single inactive joint, as those of fingers are? With followers it is a gripper.
bool isFingerJoint(const FrameData& frame);

/// The motion of a joint that mimics another, per motion of that.
double motionRatio(const FrameData& follower, const FrameData& source);

/// Fills in where the compiled model has what the scene calls bodies, geoms, joints, drives, grippers and sensors.
void indexModel(const ModelParts& parts, const std::vector<ModelShapes::Geom>& geoms, const KinematicModel& kinematics,
                SceneModel& model);

}  // namespace kinegraph
