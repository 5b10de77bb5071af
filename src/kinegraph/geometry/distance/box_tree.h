#pragma once

#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A box along the axes of the world.
struct WorldBox {
  Vector3d low, high;

  bool contains(const WorldBox& other) const {
    return (low.array() <= other.low.array()).all() && (other.high.array() <= high.array()).all();
  }
  /// Do they come within `reach` of each other along every axis?
  bool meets(const WorldBox& other, double reach) const {
    return (low.array() <= other.high.array() + reach).all() && (other.low.array() <= high.array() + reach).all();
  }
  void include(const WorldBox& other) {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }
  WorldBox grown(double by) const { return {low.array() - by, high.array() + by}; }
};

/// Boxes in a binary tree of boxes around them: which of them meet a given one, in a time that grows as the logarithm
/// of their number.
class BoxTree {
 public:
  /// Over boxes[i] for all i; splits at the middle of the longest side.
  void build(const std::vector<WorldBox>& boxes);

  /// Box i has moved. The order of the tree stays, so it gets slower where boxes travel far; see `spread`.
  void move(int i, const WorldBox& box);

  /// How much larger its boxes have become since it was built: 1 at first.
  double spread() const { return built_size_ > 0. ? size_ / built_size_ : 1.; }

  /// Calls visit(i) for the boxes within `reach` of one.
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
  std::vector<int> leaf_;   ///< the node of box i
  std::vector<int> order_;  ///< while it is built
  double size_ = 0., built_size_ = 0.;
};

}  // namespace kinegraph
