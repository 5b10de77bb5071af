#include "kinegraph/geometry/distance/closed_form/box_tree.h"

#include <algorithm>
#include <numeric>

namespace kinegraph::inline geometry_internal {

void BoxTree::build(const std::vector<WorldBox>& boxes) {
  nodes_.clear();
  nodes_.reserve(2 * boxes.size());
  leaf_.assign(boxes.size(), -1);
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0);
  size_ = 0.;
  if (!boxes.empty()) build(boxes, 0, int(boxes.size()), -1);
  built_size_ = size_;
}

int BoxTree::build(const std::vector<WorldBox>& boxes, int first, int last, int parent) {
  WorldBox around = boxes[std::size_t(order_[std::size_t(first)])];
  for (int i = first + 1; i < last; ++i) around.include(boxes[std::size_t(order_[std::size_t(i)])]);
  const int index = int(nodes_.size());
  nodes_.push_back({around, parent});
  size_ += sizeOf(around);
  if (last - first == 1) {
    nodes_.back().item = order_[std::size_t(first)];
    leaf_[std::size_t(nodes_.back().item)] = index;
    return index;
  }
  int axis;
  (around.high - around.low).maxCoeff(&axis);
  const int middle = (first + last) / 2;
  std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last, [&](int p, int q) {
    const double x = boxes[std::size_t(p)].low[axis] + boxes[std::size_t(p)].high[axis];
    const double y = boxes[std::size_t(q)].low[axis] + boxes[std::size_t(q)].high[axis];
    return x < y || (x == y && p < q);
  });
  const int left = build(boxes, first, middle, index);
  const int right = build(boxes, middle, last, index);
  nodes_[std::size_t(index)].left = left;
  nodes_[std::size_t(index)].right = right;
  return index;
}

void BoxTree::move(int i, const WorldBox& box) {
  int index = leaf_[std::size_t(i)];
  size_ -= sizeOf(nodes_[std::size_t(index)].box);
  nodes_[std::size_t(index)].box = box;
  size_ += sizeOf(box);
  for (index = nodes_[std::size_t(index)].parent; index >= 0; index = nodes_[std::size_t(index)].parent) {
    Node& node = nodes_[std::size_t(index)];
    WorldBox around = nodes_[std::size_t(node.left)].box;
    around.include(nodes_[std::size_t(node.right)].box);
    if (around.low == node.box.low && around.high == node.box.high) return;
    size_ += sizeOf(around) - sizeOf(node.box);
    node.box = around;
  }
}

}  // namespace kinegraph::inline geometry_internal
