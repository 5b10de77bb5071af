#include "kinegraph/komo/path/mode.h"

#include <algorithm>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

const std::vector<std::pair<std::string, SwitchMode>>& switchModeNames() {
  using M = SwitchMode;
  static const std::vector<std::pair<std::string, SwitchMode>> names = {
      {"touch", M::touch},
      {"above", M::above},
      {"inside", M::inside},
      {"oppose", M::oppose},
      {"restingOn", M::restingOn},
      {"poseEq", M::poseEq},
      {"positionEq", M::positionEq},
      {"stableRelPose", M::stableRelPose},
      {"stablePose", M::stablePose},
      {"stable", M::stable},
      {"stableOn", M::stableOn},
      {"dynamic", M::dynamic},
      {"dynamicOn", M::dynamicOn},
      {"dynamicTrans", M::dynamicTrans},
      {"quasiStatic", M::quasiStatic},
      {"quasiStaticOn", M::quasiStaticOn},
      {"downUp", M::downUp},
      {"stableZero", M::stableZero},
      {"contact", M::contact},
      {"contactStick", M::contactStick},
      {"contactComplementary", M::contactComplementary},
      {"bounce", M::bounce},
      {"push", M::push},
      {"magic", M::magic},
      {"magicTrans", M::magicTrans},
      {"pushAndPlace", M::pushAndPlace},
      {"topBoxGrasp", M::topBoxGrasp},
      {"topBoxPlace", M::topBoxPlace},
      {"dampMotion", M::dampMotion},
      {"identical", M::identical},
      {"alignByInt", M::alignByInt},
      {"makeFree", M::makeFree},
      {"forceBalance", M::forceBalance},
      {"relPosY", M::relPosY},
      {"touchBoxNormalX", M::touchBoxNormalX},
      {"touchBoxNormalY", M::touchBoxNormalY},
      {"touchBoxNormalZ", M::touchBoxNormalZ},
      {"boxGraspX", M::boxGraspX},
      {"boxGraspY", M::boxGraspY},
      {"boxGraspZ", M::boxGraspZ},
      {"lift", M::lift},
      {"stableYPhi", M::stableYPhi},
      {"stableOnX", M::stableOnX},
      {"stableOnY", M::stableOnY},
      {"end", M::end}};
  return names;
}

std::string switchModeName(SwitchMode mode) {
  for (const auto& [name, value] : switchModeNames()) {
    if (value == mode) return name;
  }
  return cat(int(mode));
}

namespace {

using Body = ShapeKind::Body;

const ShapeKind& kindOf(const Frame& frame) { return shapeKind(frame.getShapeType()); }

bool isBox(const Frame& frame) { return kindOf(frame).body == Body::box; }

/// Returns the size that determines the range of free joints at a frame, m; 0 without a body.
double reach(const Frame& frame) {
  const ShapeKind& kind = kindOf(frame);
  const std::vector<double> size = frame.getSize();
  if (size.empty() || kind.is_symbol) return 0.;
  const bool doubled = kind.body == Body::ball || kind.body == Body::cylinder;
  return doubled ? 2. * size[0] : *std::max_element(size.begin(), size.end());
}

}  // namespace

double komo_internal::height(const Frame& frame) { return shapeHeight(frame.getShapeType(), frame.getSize()); }

namespace {

/// Returns the pose of a joint on the face of `box` along an axis, for an object of this height. Its z axis points
/// outwards.
Pose faceBase(const std::vector<double>& box, int axis, double object_height) {
  Pose base;
  base.p[axis] = .5 * (box[axis] + object_height);
  const double quarter = .5 * std::numbers::pi;
  if (axis == 0) base.q = Eigen::AngleAxisd(quarter, Vector3d::UnitY());
  if (axis == 1) base.q = Eigen::AngleAxisd(-quarter, Vector3d::UnitX());
  return base;
}

}  // namespace

void komo_internal::limitFreeJoint(Attachment& attachment, const Frame& parent, const Frame* object) {
  const double range = .9 * (reach(parent) + (object ? reach(*object) : 0.));
  if (range <= 0.) return;
  attachment.upper = (Eigen::Matrix<double, 7, 1>() << range, range, range, 1.1, 1.1, 1.1, 1.1).finished();
  attachment.lower = -attachment.upper;
}

void komo_internal::limitSliding(Attachment& attachment, double half_x, double half_y) {
  attachment.upper = Vector3d(half_x, half_y, 2. * std::numbers::pi);
  attachment.lower = -attachment.upper;
}

void komo_internal::limitByType(Attachment& attachment, const Frame& parent) {
  const std::vector<double> size = parent.getSize();
  const auto symmetric = [&](const VectorXd& upper) {
    attachment.upper = upper;
    attachment.lower = -upper;
  };
  switch (attachment.type) {
    case JointType::free:
      return limitFreeJoint(attachment, parent, nullptr);
    case JointType::hingeX:
    case JointType::hingeY:
    case JointType::hingeZ:
      return symmetric(VectorXd::Constant(1, 2. * std::numbers::pi));
    case JointType::quatBall:
      return symmetric(VectorXd::Constant(4, 1.1));
    case JointType::transXY:
      if (isBox(parent)) symmetric(.5 * Eigen::Vector2d(size[0], size[1]));
      return;
    case JointType::transXYPhi:
      if (isBox(parent)) limitSliding(attachment, .5 * size[0], .5 * size[1]);
      return;
    default:
      return;
  }
}

bool isAttachment(SwitchMode mode) {
  using M = SwitchMode;
  switch (mode) {
    case M::stable:
    case M::stableOn:
    case M::stableOnX:
    case M::stableOnY:
    case M::stableYPhi:
    case M::stableZero:
    case M::dynamic:
    case M::dynamicOn:
    case M::dynamicTrans:
    case M::quasiStatic:
    case M::quasiStaticOn:
    case M::magic:
    case M::magicTrans:
      return true;
    default:
      return false;
  }
}

namespace {

/// Returns a joint whose initial value and home are at the object's pose.
Attachment atObject(JointType type, bool stable) {
  Attachment a;
  a.type = type;
  a.stable = stable;
  a.starts_at_object = true;
  a.zero_home = false;
  return a;
}

/// Returns a joint at the object's pose that preserves its orientation.
Attachment atObjectUnrotated(JointType type, const Frame& parent, const Frame& object) {
  Attachment a = atObject(type, false);
  a.base = Pose();
  a.base->q = (parent.getPose().inverse() * object.getPose()).q;
  return a;
}

/// Returns the sides of the box that a mode needs.
std::vector<double> boxOf(const Frame& parent, SwitchMode mode, const Frame& object) {
  if (isBox(parent)) return parent.getSize();
  throw ValueError(cat("addModeSwitch: ", switchModeName(mode), " needs a box (ssBox) to place '", object.getName(),
                       "' on; '", parent.getName(), "' has ",
                       parent.getShapeType() == ShapeType::none ? "no shape" : "another shape"));
}

/// Places an object on the face of a box along an axis.
Attachment onFace(const std::vector<double>& box, int axis, const Frame& object) {
  Attachment a;
  a.type = JointType::transXYPhi;
  a.starts_at_object = axis == 2;
  a.uniform = true;
  a.base = faceBase(box, axis, height(object));
  limitSliding(a, .5 * box[axis == 0 ? 2 : 0], .5 * box[axis == 1 ? 2 : 1]);
  return a;
}

/// Lets an object slide on the top of a box.
Attachment onTop(const std::vector<double>& box, const Frame& object) {
  Attachment a = atObject(JointType::transXYPhi, false);
  a.base = faceBase(box, 2, height(object));
  return a;
}

/// Lets an object move in the plane of the parent, at its present height and orientation.
Attachment inPlane(const Frame& parent, const Frame& object) {
  Attachment a = atObjectUnrotated(JointType::transXY, parent, object);
  const Pose relative = parent.getPose().inverse() * object.getPose();
  const Vector3d along = relative.q.inverse() * relative.p;  // in the axes of the object
  a.base->p = relative.p - relative.q * Vector3d(along.cwiseProduct(Vector3d(1., 1., 0.)));
  return a;
}

}  // namespace

Attachment komo_internal::attachmentOf(SwitchMode mode, const Frame& parent, const Frame& object) {
  using M = SwitchMode;
  switch (mode) {
    case M::stable: {
      Attachment a = atObject(JointType::free, true);
      limitFreeJoint(a, parent, &object);
      return a;
    }
    case M::stableOn:
      return onFace(boxOf(parent, mode, object), 2, object);
    case M::stableOnX:
      return onFace(boxOf(parent, mode, object), 0, object);
    case M::stableOnY:
      return onFace(boxOf(parent, mode, object), 1, object);
    case M::stableYPhi:
      return atObject(JointType::transY, true);
    case M::stableZero:
      return {};
    case M::dynamic:
    case M::quasiStatic:
    case M::magic:
      return atObject(JointType::free, false);
    case M::dynamicTrans:
      return atObjectUnrotated(JointType::trans3, parent, object);
    case M::dynamicOn:
      return onTop(boxOf(parent, mode, object), object);
    case M::quasiStaticOn: {
      const std::vector<double> box = boxOf(parent, mode, object);
      Attachment a = onTop(box, object);
      limitSliding(a, .5 * box[0], .5 * box[1]);
      return a;
    }
    case M::magicTrans:
      return inPlane(parent, object);
    default:
      throw ValueError(cat(
          "addModeSwitch: ", switchModeName(mode),
          " does not attach an object; expected one of stable, stableOn, "
          "stableOnX, stableOnY, stableYPhi, stableZero, dynamic, dynamicOn, dynamicTrans, quasiStatic, quasiStaticOn, "
          "magic, magicTrans; a skeleton accepts all modes"));
  }
}

void komo_internal::addJoint(FrameData& frame, const Attachment& attachment, const Pose& relative) {
  Joint joint(attachment.type);
  frame.pose = Pose();
  if (joint.dofs() > 0) {
    if (attachment.starts_at_object) joint.q = motionProject(joint.steps, joint.axis, joint.scale, relative);
    if (!attachment.zero_home) joint.home = joint.q;
    joint.lower = attachment.lower;
    joint.upper = attachment.upper;
    joint.stable = attachment.stable;
    joint.sample_uniform = attachment.uniform ? 1. : 0.;
  }
  frame.joint = std::move(joint);
}

const FrameData& Mode::movableRoot(const std::string& object, const std::string& parent) const {
  const SceneTree& scene = *config.scene();
  const FrameData& named = scene.get(object, "mode switch");
  const FrameData* root = &named;
  while (!root->joint && root->parent) root = root->parent;
  for (const FrameData* above = &scene.get(parent, "mode switch"); above; above = above->parent) {
    if (above == root) return named;
  }
  return *root;
}

void Mode::attach(const std::string& parent, const std::string& object, const Attachment& attachment, int base_frame,
                  int id) {
  SceneTree& scene = *config.scene();
  FrameData& below = scene.get(parent, "mode switch");
  FrameData& named = scene.get(object, "mode switch");
  const FrameData& root = movableRoot(object, parent);
  const Pose X_WO = named.worldPose();
  std::vector<FrameData*> chain;  // from the object up to its movable root
  for (FrameData* frame = &named;; frame = frame->parent) {
    chain.push_back(frame);
    if (frame == &root) break;
  }
  std::vector<Pose> upwards;  // pose of each frame of the chain relative to the previous one
  for (std::size_t i = 0; i + 1 < chain.size(); ++i) upwards.push_back(chain[i]->relativePose().inverse());
  for (FrameData* frame : chain) {
    if (frame->parent) scene.unlink(*frame);
    frame->joint.reset();
    added.erase(frame->id);
  }
  for (std::size_t i = 0; i < upwards.size(); ++i) {
    scene.link(*chain[i + 1], *chain[i]);
    chain[i + 1]->pose = upwards[i];
  }
  FrameData* seat = &below;
  if (attachment.base) {
    seat = scene.frames()[base_frame].get();
    scene.link(*seat, below);
    seat->pose = *attachment.base;
  }
  named.pose = X_WO;
  scene.link(named, *seat);
  addJoint(named, attachment, seat->worldPose().inverse() * X_WO);
  added[named.id] = {id, attachment.stable, parent};
  scene.structureChanged();
}

}  // namespace kinegraph
