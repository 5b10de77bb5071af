#include <algorithm>
#include <cmath>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/tree_edits.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr double kSamePlace = 1e-10;

bool isEmpty(const Shape& shape) {
  const Geometry& geometry = *shape.geometry;
  return geometry.type == ShapeType::none ||
         (shapeKind(geometry.type).hasPoints() && (!geometry.mesh || geometry.mesh->vertices.empty()));
}

void moveBelow(SceneTree& scene, FrameData& frame, FrameData& parent, const Pose& relative) {
  scene.link(frame, parent);
  frame.pose = relative;
}

void reconnectToLinks(SceneTree& scene) {
  for (const auto& frame : scene.frames()) {
    if (!frame->parent) continue;
    Pose before;  // pose of the current parent in its link's frame
    FrameData* link = frame->parent;
    for (; link->parent && !link->joint; link = link->parent) before = link->relativePose() * before;
    if (link == frame->parent) continue;
    if (!frame->moves()) {
      moveBelow(scene, *frame, *link, before * frame->pose);
    } else if (before.isIdentity(kSamePlace)) {
      scene.link(*frame, *link);
    }
  }
}

void takeShapesOfChildren(SceneTree& scene) {
  for (const auto& frame : scene.frames()) {
    if (frame->shape) continue;
    for (FrameData* child : frame->children) {
      const bool only_shape = child->shape && !child->joint && !child->inertia && child->children.empty();
      if (!only_shape || !child->pose.isIdentity(kSamePlace)) continue;
      frame->shape = std::move(child->shape);
      child->shape.reset();
      break;
    }
  }
}

bool isUseless(const FrameData& frame, const Simplification& options) {
  if (!frame.children.empty() || frame.joint || frame.inertia) return false;
  if (!frame.shape) return true;
  if (options.prune_non_contact_shapes && frame.shape->contact == 0 && frame.shape->geometry->type != ShapeType::marker)
    return true;
  return options.prune_transparent && frame.shape->color && (*frame.shape->color)[3] < 1.;
}

void removeUseless(SceneTree& scene, const Simplification& options) {
  for (bool found = true; found;) {
    const auto& frames = scene.frames();
    const auto useless =
        std::find_if(frames.rbegin(), frames.rend(), [&](const auto& frame) { return isUseless(*frame, options); });
    found = useless != frames.rend();
    if (found) scene.remove(**useless);
  }
}

}  // namespace

void simplifyStructure(SceneTree& scene, const Simplification& options) {
  for (const auto& frame : scene.frames()) {
    if (frame->shape && isEmpty(*frame->shape)) frame->shape.reset();
    if (options.prune_rigid_joints && frame->joint && frame->joint->dofs() == 0) frame->joint.reset();
  }
  if (options.reconnect_to_links) {
    reconnectToLinks(scene);
    takeShapesOfChildren(scene);
  }
  removeUseless(scene, options);
  scene.sortByDepth();
}

namespace {

void require(bool holds, const FrameData& frame, const std::string& what) {
  if (!holds) throw Error(cat("checkConsistency: frame '", frame.name, "' (", frame.id, "): ", what));
}

void checkJoint(const SceneTree& scene, const FrameData& frame) {
  const Joint& joint = *frame.joint;
  require(frame.parent, frame, "a root has a joint");
  require(joint.dofs() == motionDofs(joint.steps) && joint.q.size() == joint.dofs(), frame,
          "its joint has a wrong number of dofs");
  require(joint.lower.size() == joint.upper.size() && (joint.lower.size() == 0 || joint.lower.size() == joint.dofs()),
          frame, "its joint has a wrong number of limits");
  require((joint.lower.array() <= joint.upper.array()).all(), frame, "a lower limit is above its upper limit");
  require(joint.q.allFinite() && joint.home.allFinite() && std::isfinite(joint.scale), frame,
          "its joint has numbers that are not finite");
  if (!joint.mimic) return;
  const FrameData& source = *joint.mimic;
  const bool here =
      source.tree == &scene && source.id < int(scene.frames().size()) && scene.frames()[source.id].get() == &source;
  require(here && source.joint && source.joint->dofs() == joint.dofs(), frame,
          "its joint mimics a joint of another scene or of another number of dofs");
  std::set<const FrameData*> seen = {&frame};
  for (const FrameData* next = &source; next->joint && next->joint->mimic; next = next->joint->mimic) {
    require(seen.insert(next).second, frame, "its joint mimics itself");
  }
}

}  // namespace

void checkConsistency(const SceneTree& scene) {
  const auto& frames = scene.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const FrameData& frame = *frames[i];
    require(frame.id == int(i) && frame.tree == &scene, frame, cat("is at index ", i));
    const FrameData* above = &frame;
    for (std::size_t steps = 0; above->parent; above = above->parent)
      require(++steps <= frames.size(), frame, "its parents form a loop");
    if (frame.parent) {
      const auto& siblings = frame.parent->children;
      require(frame.parent->tree == &scene, frame, "its parent is not in this scene");
      require(std::count(siblings.begin(), siblings.end(), &frame) == 1, frame,
              "its parent does not know it as a child");
    }
    for (const FrameData* child : frame.children)
      require(child->parent == &frame, frame, cat("its child '", child->name, "' has another parent"));
    require(frame.pose.p.allFinite() && frame.pose.q.coeffs().allFinite(), frame,
            "its pose has numbers that are not finite");
    require(std::abs(frame.pose.q.norm() - 1.) < 1e-6, frame, "the quaternion of its pose is not unit");
    if (frame.joint) checkJoint(scene, frame);
    if (frame.inertia)
      require(std::isfinite(frame.inertia->mass) && frame.inertia->matrix.allFinite(), frame,
              "its inertia has numbers that are not finite");
  }
}

}  // namespace kinegraph::inline scene_internal
