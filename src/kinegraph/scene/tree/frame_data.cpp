#include "kinegraph/scene/tree/frame_data.h"

#include <utility>

#include "kinegraph/geometry/distance/shared_body.h"

namespace kinegraph {

Joint::Joint(JointType joint_type, std::string joint_code)
    : type(joint_type), code(std::move(joint_code)), steps(motionSteps(type, code)) {
  q = home = motionIdentity(steps);
}

std::shared_ptr<const CollisionBody> Shape::body() const {
  {
    const std::lock_guard lock(body_cache_->mutex);
    if (!body_cache_->of) {
      body_cache_->body = sharedCollisionBody(*geometry);
      body_cache_->of = geometry;
    }
    if (body_cache_->of == geometry) return body_cache_->body;
  }
  body_cache_ = std::make_shared<BodyCache>();  // the copies have another geometry
  return body();
}

Pose FrameData::relativePose() const {
  if (!moves()) return pose;
  const Joint& source = *dofSource(*this).joint;
  return motionPose(joint->steps, joint->axis, motionScale(*this), source.q.data());
}

Pose FrameData::worldPose() const {
  Pose X = relativePose();
  for (const FrameData* frame = parent; frame; frame = frame->parent) X = frame->relativePose() * X;
  return X;
}

const FrameData& dofSource(const FrameData& frame) {
  const FrameData* source = &frame;
  while (source->joint && source->joint->mimic) source = source->joint->mimic;
  return *source;
}

double motionScale(const FrameData& frame) {
  const double own = frame.joint->scale;
  return frame.joint->mimic ? own * dofSource(frame).joint->scale : own;
}

FrameData& dofSource(FrameData& frame) { return const_cast<FrameData&>(dofSource(std::as_const(frame))); }

}  // namespace kinegraph
