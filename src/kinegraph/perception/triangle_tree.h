#pragma once

#include <vector>

#include "kinegraph/perception/visible_shape.h"

namespace kinegraph::inline perception_internal {

/// Triangles in a binary tree of bounding spheres, for the distance of points. Local coordinates.
struct TriangleTree {
  explicit TriangleTree(const Mesh& mesh);

  /// The nearest triangle, of those that face `eye` if it is given. The sign is that of the side of its plane.
  SurfaceDistance nearest(const Vector3d& point, const Vector3d* eye) const;

  struct Triangle {
    Vector3d a, b, c, normal;
  };
  struct Node {
    Vector3d center;
    double radius;
    int left = -1, right = -1;  ///< of an inner node
    int triangle = -1;          ///< of a leaf
  };
  std::vector<Triangle> triangles;
  std::vector<Node> nodes;

 private:
  int build(std::vector<int>& order, int first, int last);
};

}  // namespace kinegraph::inline perception_internal
