#include "kinegraph/geometry/distance/half_space_distance.h"

#include <cmath>
#include <limits>

#include "kinegraph/geometry/distance/body_tree.h"
#include "kinegraph/geometry/distance/grid_field.h"

namespace kinegraph::inline geometry_internal {

namespace {

using Core = CollisionBody::Core;

constexpr double kFlat = 1e-9;  // a direction with a smaller component is perpendicular to that axis

/// The middle of the farthest feature of a core along a unit vector, local.
Vector3d middleOfFarthest(const CollisionBody& body, const Vector3d& direction) {
  Vector3d farthest = body.support(direction);
  const Vector3d kept = (direction.cwiseAbs().array() > kFlat).cast<double>();
  switch (body.core()) {
    case Core::segment:
      return {0., 0., kept.z() * farthest.z()};
    case Core::box:
      return farthest.cwiseProduct(kept);
    case Core::cylinder:
      if (direction.head<2>().norm() <= kFlat) farthest.head<2>().setZero();
      farthest.z() *= kept.z();
      return farthest;
    default:
      return farthest;
  }
}

class LowestPart {
 public:
  LowestPart(const BodyTree& tree, const RigidTransform& X_WB, const RigidTransform& X_WH)
      : tree_(tree), X_WB_(X_WB), X_WH_(X_WH) {
    nearest_.distance = std::numeric_limits<double>::infinity();
  }

  Proximity find() {
    visit(0);
    return nearest_;
  }

 private:
  double bound(int node) const {
    const BodyTree::Node& at = tree_.nodes[std::size_t(node)];
    return X_WH_.R.col(2).dot(X_WB_ * at.center - X_WH_.p) - at.radius;
  }

  void visit(int node) {
    if (bound(node) > nearest_.distance) return;
    const BodyTree::Node& at = tree_.nodes[std::size_t(node)];
    if (at.part >= 0) {
      const Proximity near = ofPart(std::size_t(at.part));
      if (near.distance < nearest_.distance) nearest_ = near;
      return;
    }
    const bool left_first = bound(at.left) <= bound(at.right);
    visit(left_first ? at.left : at.right);
    visit(left_first ? at.right : at.left);
  }

  Proximity ofPart(std::size_t part) const {
    if (!tree_.bodies.empty()) return toHalfSpace(*tree_.bodies[part], X_WB_, X_WH_);
    RigidTransform X = X_WB_;
    X.p = X_WB_ * tree_.points[part];
    return toHalfSpace(*pointBody(), X, X_WH_);
  }

  const BodyTree& tree_;
  const RigidTransform &X_WB_, &X_WH_;
  Proximity nearest_;
};

/// Proximity of the body with all of its parts inflated by the radius of a compound.
Proximity inflated(Proximity near, double radius) {
  near.distance -= radius;
  near.point_a -= radius * near.normal;
  return near;
}

}  // namespace

Proximity toHalfSpace(const CollisionBody& body, const RigidTransform& X_WB, const RigidTransform& X_WH) {
  if (body.core() == Core::compound) return inflated(LowestPart(body.tree(), X_WB, X_WH).find(), body.radius());
  if (body.core() == Core::grid) return toHalfSpace(*body.grid().surface, X_WB, X_WH);
  Proximity near;
  near.normal = X_WH.R.col(2);
  if (body.core() == Core::half_space) {
    near.distance = near.core_distance = std::numeric_limits<double>::infinity();
    near.point_a = near.core_a = X_WB.p;
    near.point_b = near.core_b = X_WH.p;
    return near;
  }
  near.core_a = X_WB * middleOfFarthest(body, -(X_WB.R.transpose() * near.normal));
  near.core_distance = near.normal.dot(near.core_a - X_WH.p);
  near.core_b = near.point_b = near.core_a - near.core_distance * near.normal;
  near.distance = near.core_distance - body.radius();
  near.point_a = near.core_a - body.radius() * near.normal;
  return near;
}

}  // namespace kinegraph::inline geometry_internal
