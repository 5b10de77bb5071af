#include "kinegraph/scene/tree/inertia_edits.h"

#include <Eigen/Eigenvalues>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/mass.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/shape_types.h"

namespace kinegraph::inline scene_internal {

namespace {

void addBelow(FrameData& frame, const Pose& X, LinkInertia& sum) {
  if (frame.inertia) sum.add({frame.inertia->mass, frame.inertia->com, frame.inertia->matrix}, X.transform());
  for (FrameData* child : frame.children) {
    if (!child->joint) addBelow(*child, X * child->pose, sum);
  }
}

void clearBelow(FrameData& frame) {
  frame.inertia.reset();
  for (FrameData* child : frame.children) {
    if (!child->joint) clearBelow(*child);
  }
}

/// Pose of the principal axes in the frame: right-handed, as close to the frame's own axes as possible.
Pose principalAxes(const Inertia& inertia) {
  const Matrix3d& I = inertia.matrix;
  if (I.isDiagonal(1e-12)) return {inertia.com, Quaterniond::Identity()};
  const Matrix3d vectors = Eigen::SelfAdjointEigenSolver<Matrix3d>(.5 * (I + I.transpose())).eigenvectors();
  Matrix3d R = Matrix3d::Zero();
  bool used[3] = {false, false, false};
  for (int axis = 0; axis < 3; ++axis) {
    int best = -1;
    for (int k = 0; k < 3; ++k) {
      if (!used[k] && (best < 0 || std::abs(vectors(axis, k)) > std::abs(vectors(axis, best)))) best = k;
    }
    used[best] = true;
    R.col(axis) = (vectors(axis, best) < 0. ? -1. : 1.) * vectors.col(best);
  }
  if (R.determinant() < 0.) R.col(2) = -R.col(2);
  return {inertia.com, Quaterniond(R).normalized()};
}

Inertia inAxes(const Inertia& inertia, const Pose& X) {
  const Matrix3d R = X.q.toRotationMatrix();
  const Vector3d moments = (R.transpose() * inertia.matrix * R).diagonal();
  return {inertia.mass, X.q.conjugate() * (inertia.com - X.p), moments.asDiagonal()};
}

bool hasFreePoints(const Geometry& geometry) {
  return shapeKind(geometry.type).hasPoints() && geometry.mesh != nullptr;
}

bool canMove(const FrameData& frame, bool transform_mesh) {
  if (frame.moves()) return false;
  if (!frame.shape || frame.shape->geometry->type == ShapeType::marker) return true;
  return transform_mesh && hasFreePoints(*frame.shape->geometry) && frame.shape.use_count() == 1;
}

void moveShape(SceneTree& scene, Shape& shape, const Pose& back) {
  Geometry geometry = *shape.geometry;
  Mesh mesh = *geometry.mesh;
  for (Vector3d& p : mesh.vertices) p = back.p + back.q * p;
  geometry.mesh = std::make_shared<Mesh>(std::move(mesh));
  geometry.mesh_file.clear();  // the points differ from the file's now
  geometry.mesh_scale.setOnes();
  shape.geometry = std::make_shared<Geometry>(std::move(geometry));
  shape.visual_pose = back * shape.visual_pose;
  scene.looksChanged(shape);
}

void addSurfaceMasses(SceneTree& scene) {
  for (const auto& frame : scene.frames()) {
    if (!frame->shape) continue;
    const Geometry& geometry = *frame->shape->geometry;
    const bool transparent = frame->shape->color && (*frame->shape->color)[3] < 1.;
    if (transparent && !frame->attributes->find("simulate")) {
      frame->inertia.reset();
    } else if (shapeKind(geometry.type).has_inertia) {
      const ShellMass shell = shellMass(geometry);
      const double mass = kSurfaceDensity * shell.area;
      frame->inertia = Inertia{mass, shell.com, mass * shell.inertia_per_mass};
    }
  }
}

}  // namespace

double totalMass(const SceneTree& scene) {
  double mass = 0.;
  for (const auto& frame : scene.frames()) mass += frame->inertia ? frame->inertia->mass : 0.;
  return mass;
}

void gatherInertia(FrameData& frame) {
  LinkInertia sum;
  addBelow(frame, Pose(), sum);
  if (sum.mass == 0.) return;
  clearBelow(frame);
  frame.inertia = Inertia{sum.mass, sum.com, sum.matrix};
}

Pose moveToPrincipalAxes(SceneTree& scene, FrameData& frame, bool transform_mesh) {
  const auto refuse = [&](const std::string& why) {
    throw ValueError(cat("transformToDiagInertia: frame '", frame.name, "' ", why));
  };
  if (!frame.inertia) refuse("has no mass");
  if (frame.moves()) refuse(cat("has a ", jointTypeName(frame.joint->type), " joint, which determines its pose"));
  if (!canMove(frame, transform_mesh)) {
    const bool points = hasFreePoints(*frame.shape->geometry);
    refuse(cat("has a shape of type ", shapeTypeName(frame.shape->geometry->type),
               !points                       ? ", which would move with the frame"
               : frame.shape.use_count() > 1 ? ", shared with another frame"
                                             : "; pass transform_mesh=true to keep its points in place"));
  }
  const Pose X = principalAxes(*frame.inertia), back = X.inverse();
  frame.inertia = inAxes(*frame.inertia, X);
  frame.pose = frame.pose * X;
  for (FrameData* child : frame.children) {
    if (child->moves()) continue;
    child->pose = back * child->pose;
  }
  for (FrameData* child : std::vector<FrameData*>(frame.children)) {
    if (!child->moves()) continue;
    FrameData& origin = scene.add(child->name + "_origin", &frame);  // a joint cannot hold the constant offset
    origin.pose = back;
    scene.link(*child, origin);
  }
  if (frame.shape && frame.shape->geometry->type != ShapeType::marker) moveShape(scene, *frame.shape, back);
  scene.structureChanged();
  return X;
}

void processInertias(SceneTree& scene, const InertiaOptions& options) {
  if (options.recompute) addSurfaceMasses(scene);
  const std::vector<std::shared_ptr<FrameData>> frames = scene.frames();
  for (const auto& frame : frames) {
    if (frame->parent && !frame->joint) continue;
    gatherInertia(*frame);
    if (!frame->inertia || !options.principal_axes) continue;
    if (canMove(*frame, false)) {
      moveToPrincipalAxes(scene, *frame, false);
      continue;
    }
    FrameData& holder = scene.add(frame->name + "_inertia", frame.get());
    holder.pose = principalAxes(*frame->inertia);
    holder.inertia = inAxes(*frame->inertia, holder.pose);
    frame->inertia.reset();
  }
  scene.structureChanged();
}

}  // namespace kinegraph::inline scene_internal
