#include "kinegraph/scene/frame.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/geometry_flaw.h"
#include "kinegraph/geometry/shapes/mass.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/scene/tree/joint_limits.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

Frame::Frame(std::shared_ptr<SceneTree> scene, FrameData& data) : scene_(std::move(scene)) {
  data_ = scene_->frames()[data.id];
}

FrameData& Frame::data() const {
  if (!data_->tree) throw FrameDeleted(cat("frame '", data_->name, "' has been deleted from its configuration"));
  return *data_;
}

FrameData& Frame::edit() {
  if (is_const_)
    throw ValueError(cat("frame '", data().name,
                         "' is of a const Config and cannot be changed; get it from the Config ",
                         "itself, or from a copy"));
  return data();
}

Frame Frame::related(FrameData& data) const {
  Frame frame(scene_, data);
  frame.is_const_ = is_const_;
  return frame;
}

Frame& Frame::setName(std::string name) {
  const FrameData* taken = name.empty() ? nullptr : scene_->find(name);
  if (taken && taken != &edit()) {
    throw ValueError(cat("frame '", data().name, "' cannot be renamed to '", name, "'; another frame has that name"));
  }
  scene_->rename(edit(), std::move(name));
  return *this;
}

std::optional<Frame> Frame::getParent() const {
  if (!data().parent) return std::nullopt;
  return related(*data().parent);
}

std::vector<Frame> Frame::getChildren() const {
  std::vector<Frame> frames;
  for (FrameData* child : data().children) frames.push_back(related(*child));
  return frames;
}

std::vector<Frame> Frame::getSubtree() const {
  std::vector<Frame> frames;
  for (const Frame& child : getChildren()) {
    frames.push_back(child);
    for (const Frame& below : child.getSubtree()) frames.push_back(below);
  }
  return frames;
}

Pose Frame::getPose() const { return scene_->worldPose(data()); }

Pose Frame::getRelativePose() const { return data().parent ? data().relativePose() : Pose(); }

Frame& Frame::setPose(const Pose& pose) {
  FrameData& frame = edit();
  if (frame.parent) return setRelativePose(scene_->worldPose(*frame.parent).inverse() * pose);
  frame.pose = pose;
  scene_->poseChanged(frame);
  return *this;
}

Frame& Frame::setPosition(const Vector3d& position) {
  if (!data().parent) return setPose({position, data().pose.q});
  return setPose({position, getPose().q});
}

Frame& Frame::setQuaternion(const Quaterniond& rotation) {
  return setPose({getPose().p, unitQuaternion(wxyz(rotation))});
}

Frame& Frame::setRelativePose(const Pose& pose) {
  FrameData& frame = edit();
  if (!frame.parent) {
    throw ValueError(cat("frame '", frame.name, "' has no parent, so it has no relative pose; use setPose"));
  }
  if (frame.moves()) {
    const Joint& joint = *frame.joint;
    Joint& source = *dofSource(frame).joint;
    source.q = motionProject(joint.steps, joint.axis, motionScale(frame), pose);
    scene_->jointsChanged();
    if (!source.active) scene_->posesChanged();
  } else {
    frame.pose = pose;
    scene_->poseChanged(frame);
  }
  return *this;
}

Frame& Frame::setRelativePosition(const Vector3d& position) {
  return setRelativePose({position, data().relativePose().q});
}

Frame& Frame::setRelativeQuaternion(const Quaterniond& rotation) {
  return setRelativePose({data().relativePose().p, unitQuaternion(wxyz(rotation))});
}

Frame& Frame::setParent(const Frame& parent, bool keep_world_pose) {
  FrameData& frame = edit();
  if (parent.scene_ != scene_) {
    throw ValueError(cat("frame '", frame.name, "' cannot be attached to '", parent.getName(), "' of another Config"));
  }
  if (frame.parent == &parent.data()) return *this;
  const Pose world = getPose(), relative = getRelativePose();
  scene_->link(frame, parent.data());
  return keep_world_pose ? setPose(world) : setRelativePose(relative);
}

Frame& Frame::unLink() {
  FrameData& frame = edit();
  if (!frame.parent) throw ValueError(cat("frame '", frame.name, "' has no parent to be unlinked from"));
  const Pose world = getPose();
  scene_->unlink(frame);
  frame.joint.reset();
  frame.pose = world;
  return *this;
}

Shape& Frame::editableShape() {
  FrameData& frame = edit();
  if (!frame.shape) frame.shape = std::make_shared<Shape>();
  scene_->looksChanged(*frame.shape);
  return *frame.shape;
}

Frame& Frame::setGeometry(Geometry geometry) {
  if (const std::string flaw = geometryFlaw(geometry); !flaw.empty())
    throw ValueError(cat("frame '", getName(), "': ", flaw));
  editableShape().geometry = std::make_shared<Geometry>(std::move(geometry));
  scene_->structureChanged();
  return *this;
}

Frame& Frame::setShape(ShapeType type, const std::vector<double>& size) {
  if (type == ShapeType::none) throw ValueError(cat("frame '", getName(), "': setShape needs a shape type, not none"));
  Geometry geometry;
  geometry.type = type;
  try {
    geometry.size = checkedSize(type, size, nullptr);
  } catch (const ValueError& error) {
    throw ValueError(cat("frame '", getName(), "': ", error.what()));
  }
  const bool has_points = data().shape && data().shape->geometry->mesh;
  if (has_points && (type == ShapeType::ssCvx || type == ShapeType::mesh)) geometry.mesh = data().shape->geometry->mesh;
  return setGeometry(std::move(geometry));
}

Frame& Frame::setMesh(Mesh mesh) {
  Geometry geometry;
  geometry.type = mesh.triangles.empty() ? ShapeType::pointCloud : ShapeType::mesh;
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  return setGeometry(std::move(geometry));
}

Frame& Frame::setConvexCore(std::vector<Vector3d> points, double radius) {
  Geometry geometry;
  geometry.type = ShapeType::ssCvx;
  geometry.size = checkedSize(ShapeType::ssCvx, {radius}, nullptr);
  Mesh core;
  core.vertices = std::move(points);
  geometry.mesh = std::make_shared<Mesh>(std::move(core));
  return setGeometry(std::move(geometry));
}

Frame& Frame::setColor(const std::vector<double>& c) {
  Vector4d rgba(0, 0, 0, 1);
  switch (c.size()) {
    case 1:
      rgba.head<3>().setConstant(c[0]);
      break;
    case 2:
      rgba << c[0], c[0], c[0], c[1];
      break;
    case 3:
      rgba.head<3>() << c[0], c[1], c[2];
      break;
    case 4:
      rgba << c[0], c[1], c[2], c[3];
      break;
    default:
      throw ValueError(cat("frame '", getName(),
                           "': a color has 1 (gray), 2 (gray alpha), 3 (rgb) or 4 (rgba) numbers, not ", c.size()));
  }
  if (!rgba.allFinite()) throw ValueError(cat("frame '", getName(), "': color has numbers that are not finite"));
  editableShape().color = rgba;
  return *this;
}

Frame& Frame::setContact(int contact) {
  if (!data().shape) {
    throw ValueError(cat("frame '", getName(), "' has no shape; call setShape before setContact"));
  }
  editableShape().contact = contact;
  scene_->structureChanged();
  return *this;
}

ShapeType Frame::getShapeType() const { return data().shape ? data().shape->geometry->type : ShapeType::none; }

std::vector<double> Frame::getSize() const {
  return data().shape ? data().shape->geometry->size : std::vector<double>();
}

Frame& Frame::setJoint(JointType type, const std::vector<double>& limits, const std::vector<double>& axis, double scale,
                       std::optional<Frame> mimic, const std::string& code) {
  FrameData& frame = edit();
  const Pose relative = frame.relativePose();
  if (type == JointType::none) {
    if (!limits.empty() || !axis.empty() || mimic) {
      throw ValueError(
          cat("frame '", frame.name, "': JointType::none removes the joint; it accepts no limits, axis or mimic"));
    }
    frame.joint.reset();
    frame.pose = relative;
    scene_->structureChanged();
    return *this;
  }
  if (!frame.parent) {
    throw ValueError(cat("frame '", frame.name,
                         "' has no parent, so it cannot have a joint: a joint moves a frame relative to its ",
                         "parent; call setParent first, for instance with a new frame 'world' that stays"));
  }
  Joint joint(type, code);
  const std::size_t dofs = joint.dofs();
  std::vector<double> given = limits;
  if (!limits.empty()) {
    if (limits.size() != 2 * dofs) {
      throw ValueError(cat("frame '", frame.name, "': limits of a ", jointTypeName(type), " joint are ", 2 * dofs,
                           " numbers (all lower, then all upper), not ", limits.size()));
    }
    std::string in_turn;
    given = limitsInTurn(limits, in_turn).value_or(limits);
    joint.lower = Eigen::Map<const VectorXd>(given.data(), dofs);
    joint.upper = Eigen::Map<const VectorXd>(given.data() + dofs, dofs);
    if (const std::string why = limitsError(given); !why.empty())
      throw ValueError(cat("frame '", frame.name, "': ", why));
  }
  if (!axis.empty()) {
    const Vector3d given = axis.size() == 3 ? Vector3d(axis[0], axis[1], axis[2]) : Vector3d::Zero().eval();
    if (type != JointType::hinge || !(given.norm() > 1e-10)) {
      throw ValueError(
          cat("frame '", frame.name, "': axis is 3 numbers, not all zero, and only for a joint of type hinge"));
    }
    joint.axis = given.normalized();
  }
  joint.scale = scale;
  if (mimic) {
    const FrameData& source = dofSource(mimic->data());
    if (!source.joint || source.joint->type != type || &source == &frame) {
      throw ValueError(
          cat("frame '", frame.name, "' cannot mimic '", mimic->getName(), "', which has ",
              source.joint ? "a joint of type " + jointTypeName(source.joint->type) : std::string("no joint"),
              "; expected another frame with a ", jointTypeName(type), " joint"));
    }
    joint.mimic = &dofSource(mimic->data());
  }
  if (dofs > 0 && !joint.mimic) {
    joint.q = motionProject(joint.steps, joint.axis, joint.scale, relative);
    moveToEqualLimits(joint.steps, given, {joint.q.data(), dofs});
    joint.home = joint.q;
  }
  if (dofs == 0) frame.pose = relative;
  frame.joint = std::move(joint);
  scene_->structureChanged();
  return *this;
}

JointType Frame::getJointType() const { return data().joint ? data().joint->type : JointType::none; }

VectorXd Frame::getJointState() const {
  if (!data().joint) throw ValueError(cat("frame '", getName(), "' has no joint"));
  return dofSource(data()).joint->q;
}

Frame& Frame::setJointState(const VectorXd& q) {
  FrameData& frame = edit();
  if (!frame.joint) throw ValueError(cat("frame '", frame.name, "' has no joint"));
  Joint& joint = *dofSource(frame).joint;
  if (q.size() != joint.dofs() || !q.allFinite()) {
    throw ValueError(cat("frame '", frame.name, "': its ", jointTypeName(joint.type), " joint takes ", joint.dofs(),
                         " finite numbers, got ", q.size(), ": ", q.transpose()));
  }
  joint.q = q;
  scene_->jointsChanged();
  if (!joint.active) scene_->posesChanged();
  return *this;
}

Frame& Frame::setMass(double mass, const std::vector<double>& matrix) {
  FrameData& frame = edit();
  if (!(mass >= 0.) || std::isinf(mass))
    throw ValueError(cat("frame '", frame.name, "': mass ", mass, " kg is not zero, or positive and finite"));
  if (mass == 0.) {
    frame.inertia.reset();
    scene_->posesChanged();
    return *this;
  }
  Inertia inertia;
  inertia.mass = mass;
  const std::vector<double>& m = matrix;
  if (m.size() == 3) {
    inertia.matrix = Vector3d(m[0], m[1], m[2]).asDiagonal();
  } else if (m.size() == 6) {
    inertia.matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  } else if (m.size() == 9) {
    inertia.matrix = Eigen::Map<const Matrix3d>(m.data()).transpose();
  } else if (!m.empty()) {
    throw ValueError(cat("frame '", frame.name,
                         "': an inertia matrix is 3 (diagonal), 6 (xx xy xz yy yz zz) or 9 numbers, not ", m.size()));
  } else if (frame.shape && frame.shape->geometry->type != ShapeType::marker) {
    const ShellMass shell = shellMass(*frame.shape->geometry);
    inertia.com = shell.com;
    inertia.matrix = mass * shell.inertia_per_mass;
  } else {
    inertia.matrix = 1e-4 * mass * Matrix3d::Identity();
  }
  frame.inertia = inertia;
  scene_->posesChanged();
  return *this;
}

double Frame::getMass() const { return data().inertia ? data().inertia->mass : 0.; }

}  // namespace kinegraph
