#include "kinegraph/perception/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline perception_internal {

namespace {

/// Nearest point of a triangle. Source: Ericson, Real-Time Collision Detection, 5.1.5.
Vector3d nearestOnTriangle(const TriangleTree::Triangle& t, const Vector3d& p) {
  const Vector3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, bp = p - t.b, cp = p - t.c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0. && d2 <= 0.) return t.a;
  if (d3 >= 0. && d4 <= d3) return t.b;
  if (d6 >= 0. && d5 <= d6) return t.c;
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  if (vc <= 0. && d1 >= 0. && d3 <= 0.) return t.a + d1 / (d1 - d3) * ab;
  if (vb <= 0. && d2 >= 0. && d6 <= 0.) return t.a + d2 / (d2 - d6) * ac;
  if (va <= 0. && d4 >= d3 && d5 >= d6) return t.b + (d4 - d3) / (d4 - d3 + d5 - d6) * (t.c - t.b);
  return t.a + (vb * ab + vc * ac) / (va + vb + vc);
}

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  for (const auto& corners : mesh.triangles) {
    Triangle t{mesh.vertices[corners[0]], mesh.vertices[corners[1]], mesh.vertices[corners[2]], {}};
    const Vector3d normal = (t.b - t.a).cross(t.c - t.a);
    if (normal.norm() < 1e-14) continue;
    t.normal = normal.normalized();
    triangles.push_back(t);
  }
  std::vector<int> order(triangles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = int(i);
  nodes.reserve(2 * order.size());
  if (!order.empty()) build(order, 0, int(order.size()));
}

int TriangleTree::build(std::vector<int>& order, int first, int last) {
  Eigen::AlignedBox3d box;
  for (int i = first; i < last; ++i) {
    const Triangle& t = triangles[std::size_t(order[std::size_t(i)])];
    box.extend(t.a).extend(t.b).extend(t.c);
  }
  const int index = int(nodes.size());
  nodes.push_back({box.center(), 0.});
  for (int i = first; i < last; ++i) {
    const Triangle& t = triangles[std::size_t(order[std::size_t(i)])];
    for (const Vector3d& corner : {t.a, t.b, t.c})
      nodes.back().radius = std::max(nodes.back().radius, (corner - box.center()).norm());
  }
  if (last - first == 1) {
    nodes.back().triangle = order[std::size_t(first)];
    return index;
  }
  int axis;
  box.sizes().maxCoeff(&axis);
  const int middle = (first + last) / 2;
  const auto along = [&](int i) {
    const Triangle& t = triangles[std::size_t(i)];
    return t.a[axis] + t.b[axis] + t.c[axis];
  };
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                   [&](int a, int b) { return along(a) < along(b); });
  const int left = build(order, first, middle), right = build(order, middle, last);
  nodes[std::size_t(index)].left = left;
  nodes[std::size_t(index)].right = right;
  return index;
}

SurfaceDistance TriangleTree::nearest(const Vector3d& point, const Vector3d* eye) const {
  SurfaceDistance best;
  double least = std::numeric_limits<double>::infinity();
  const auto visit = [&](const auto& self, int index) -> void {
    const Node& node = nodes[std::size_t(index)];
    if ((point - node.center).norm() - node.radius >= least) return;
    if (node.triangle < 0) {
      const auto away = [&](int i) { return (point - nodes[std::size_t(i)].center).squaredNorm(); };
      const bool left_first = away(node.left) < away(node.right);
      self(self, left_first ? node.left : node.right);
      self(self, left_first ? node.right : node.left);
      return;
    }
    const Triangle& t = triangles[std::size_t(node.triangle)];
    if (eye && t.normal.dot(*eye - t.a) <= 0.) return;
    const Vector3d gap = point - nearestOnTriangle(t, point);
    const double length = gap.norm();
    if (length >= least) return;
    least = length;
    const double side = t.normal.dot(point - t.a) < 0. ? -1. : 1.;
    best.distance = side * length;
    best.gradient = length > 1e-9 ? Vector3d(side / length * gap) : t.normal;
  };
  if (!nodes.empty()) visit(visit, 0);
  return best;
}

}  // namespace kinegraph::inline perception_internal
