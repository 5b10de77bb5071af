#pragma once

#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline geometry_internal {

/// A world-axis-aligned box.
struct WorldBox {
  Vector3d low, high;

  bool contains(const WorldBox& other) const {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
  /// Returns whether the boxes are within `reach` of each other along every axis.
  bool meets(const WorldBox& other, double reach) const {
    return (low.array() <= other.high.array() + reach).all() && (other.low.array() <= high.array() + reach).all();
  }
  void include(const WorldBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  WorldBox grown(double by) const { return {low.array() - by, high.array() + by}; }
};

/// A binary tree of bounding boxes: finds the boxes that overlap a given one in a time that grows with the logarithm of
/// their number.
class BoxTree {
 public:
  /// Builds the tree over boxes[i] for all i; splits at the middle of the longest side.
  void build(const std::vector<WorldBox>& boxes);

  /// Updates a moved box. The order of the tree stays, so queries slow down after long moves; see `spread`.
  void move(int i, const WorldBox& box);

  /// Growth of the tree's boxes since it was built; initially 1.
  double spread() const { return built_size_ > 0. ? size_ / built_size_ : 1.; }

  /// Calls visit(i) for the boxes within `reach` of `box`.
  template <class Visit>
  void forMeeting(const WorldBox& box, double reach, const Visit& visit) const {
    if (nodes_.empty()) return;
    int stack[64], depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
      const Node& node = nodes_[std::size_t(stack[--depth])];
      if (!node.box.meets(box, reach)) continue;
      if (node.item >= 0) {
        visit(node.item);
      } else {
        stack[depth++] = node.left;
        stack[depth++] = node.right;
      }
    }
  }

 private:
  struct Node {
    WorldBox box;
    int parent = -1, left = -1, right = -1;
    int item = -1;  ///< of a leaf
  };

  int build(const std::vector<WorldBox>& boxes, int first, int last, int parent);
  static double sizeOf(const WorldBox& box) { return (box.high - box.low).sum(); }

  std::vector<Node> nodes_;
  std::vector<int> leaf_;   ///< node of box i
  std::vector<int> order_;  ///< used during construction
  double size_ = 0., built_size_ = 0.;
};

}  // namespace kinegraph::inline geometry_internal
