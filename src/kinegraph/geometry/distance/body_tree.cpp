#include "kinegraph/geometry/distance/body_tree.h"

#include <algorithm>
#include <numeric>

namespace kinegraph::inline geometry_internal {

BodyTree::BodyTree(std::vector<std::shared_ptr<const CollisionBody>> own_bodies, std::vector<Vector3d> own_points)
    : bodies(std::move(own_bodies)), points(std::move(own_points)) {
  std::vector<int> order(bodies.empty() ? points.size() : bodies.size());
  std::iota(order.begin(), order.end(), 0);
  nodes.reserve(2 * order.size());
  build(order, 0, int(order.size()));
}

int BodyTree::build(std::vector<int>& order, int first, int last) {
  const auto center = [&](int part) { return bodies.empty() ? points[part] : bodies[part]->boundCenter(); };
  const auto radius = [&](int part) { return bodies.empty() ? 0. : bodies[part]->boundRadius(); };
  Vector3d low = center(order[first]), high = low;
  for (int i = first; i < last; ++i) {
    low = low.cwiseMin(center(order[i]).array().matrix() - Vector3d::Constant(radius(order[i])));
    high = high.cwiseMax(center(order[i]).array().matrix() + Vector3d::Constant(radius(order[i])));
  }
  const int index = int(nodes.size());
  Node node{.5 * (low + high), 0.};
  for (int i = first; i < last; ++i) {
    node.radius = std::max(node.radius, (center(order[i]) - node.center).norm() + radius(order[i]));
  }
  nodes.push_back(node);
  if (last - first == 1) {
    nodes[index].part = order[first];
    return index;
  }
  int axis;
  (high - low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last, [&](int p, int q) {
    const double x = center(p)[axis], y = center(q)[axis];
    return x < y || (x == y && p < q);
  });
  const int left = build(order, first, middle);
  nodes[index].left = left;
  const int right = build(order, middle, last);
  nodes[index].right = right;
  return index;
}

}  // namespace kinegraph::inline geometry_internal
