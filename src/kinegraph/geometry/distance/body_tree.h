#pragma once

#include <memory>
#include <vector>

#include "kinegraph/geometry/distance/collision_body.h"

namespace kinegraph::inline geometry_internal {

/// The convex parts of a compound in a binary tree of bounding spheres. Local coordinates.
struct BodyTree {
  struct Node {
    Vector3d center;
    double radius;
    int left = -1, right = -1;  ///< of an inner node
    int part = -1;              ///< of a leaf
  };

  /// `bodies` share the compound's coordinates. If `bodies` is empty, the parts are `points`.
  BodyTree(std::vector<std::shared_ptr<const CollisionBody>> bodies, std::vector<Vector3d> points);

  std::vector<std::shared_ptr<const CollisionBody>> bodies;
  std::vector<Vector3d> points;
  std::vector<Node> nodes;  ///< the root is nodes[0]; children come after their parents

 private:
  int build(std::vector<int>& order, int first, int last);
};

}  // namespace kinegraph::inline geometry_internal
