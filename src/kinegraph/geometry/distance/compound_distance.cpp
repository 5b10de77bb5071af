#include "kinegraph/geometry/distance/compound_distance.h"

#include <limits>

#include "kinegraph/geometry/distance/body_tree.h"
#include "kinegraph/geometry/distance/grid_field.h"

namespace kinegraph::inline geometry_internal {

namespace {

/// One of the two bodies, as a tree of parts.
struct Side {
  const CollisionBody& body;
  const RigidTransform& X;
  const BodyTree* tree;  ///< null: the body is its only part

  Side(const CollisionBody& given, const RigidTransform& X_WB)
      : body(given), X(X_WB), tree(given.core() == CollisionBody::Core::compound ? &given.tree() : nullptr) {}

  bool isLeaf(int node) const { return !tree || tree->nodes[std::size_t(node)].part >= 0; }
  Vector3d center(int node) const { return X * (tree ? tree->nodes[std::size_t(node)].center : body.boundCenter()); }
  double radius(int node) const { return tree ? tree->nodes[std::size_t(node)].radius : body.boundRadius(); }

  const CollisionBody& part(int node, RigidTransform& X_WP) const {
    X_WP = X;
    if (!tree) return body;
    const auto index = std::size_t(tree->nodes[std::size_t(node)].part);
    if (!tree->bodies.empty()) return *tree->bodies[index];
    X_WP.p = X * tree->points[index];
    return *pointBody();
  }
};

class Nearest {
 public:
  Nearest(const Side& a, const Side& b) : a_(a), b_(b) { best_.distance = std::numeric_limits<double>::infinity(); }

  Proximity find() {
    visit(0, 0, bound(0, 0));
    return best_;
  }

 private:
  /// A lower bound of the distance between the parts of two nodes.
  double bound(int i, int j) const {
    const Vector3d center_a = a_.center(i), center_b = b_.center(j);
    const double gap = (center_a - center_b).norm() - a_.radius(i) - b_.radius(j);
    if (!a_.tree) return std::max(gap, fromCore(a_, center_b, b_.radius(j)));
    if (!b_.tree) return std::max(gap, fromCore(b_, center_a, a_.radius(i)));
    return gap;
  }

  static double fromCore(const Side& side, const Vector3d& center, double radius) {
    const double outside = std::sqrt(squaredPointToCore(side.body, side.X, center));
    return outside > 0. ? outside - side.body.radius() - radius : -std::numeric_limits<double>::infinity();
  }

  void visit(int i, int j, double low) {
    if (low >= best_.distance) return;
    const bool leaf_a = a_.isLeaf(i), leaf_b = b_.isLeaf(j);
    if (leaf_a && leaf_b) {
      RigidTransform X_a, X_b;
      const CollisionBody &part_a = a_.part(i, X_a), &part_b = b_.part(j, X_b);
      const Proximity near = proximity(part_a, X_a, part_b, X_b);
      if (near.distance < best_.distance) best_ = near;
      return;
    }
    const bool split_a = leaf_b || (!leaf_a && a_.radius(i) >= b_.radius(j));
    const BodyTree::Node& node = split_a ? a_.tree->nodes[std::size_t(i)] : b_.tree->nodes[std::size_t(j)];
    int first[2] = {i, j}, second[2] = {i, j};
    first[split_a ? 0 : 1] = node.left;
    second[split_a ? 0 : 1] = node.right;
    const double low_first = bound(first[0], first[1]), low_second = bound(second[0], second[1]);
    if (low_first <= low_second) {
      visit(first[0], first[1], low_first);
      visit(second[0], second[1], low_second);
    } else {
      visit(second[0], second[1], low_second);
      visit(first[0], first[1], low_first);
    }
  }

  const Side &a_, &b_;
  Proximity best_;
};

}  // namespace

Proximity nearestParts(const CollisionBody& a, const RigidTransform& X_WA, const CollisionBody& b,
                       const RigidTransform& X_WB) {
  if (a.core() == CollisionBody::Core::grid && b.core() == CollisionBody::Core::grid) {
    const Proximity of_a = nearestParts(*a.grid().surface, X_WA, b, X_WB),
                    of_b = nearestParts(a, X_WA, *b.grid().surface, X_WB);
    return of_a.distance <= of_b.distance ? of_a : of_b;
  }
  const Side side_a(a, X_WA), side_b(b, X_WB);
  return Nearest(side_a, side_b).find();
}

}  // namespace kinegraph::inline geometry_internal
