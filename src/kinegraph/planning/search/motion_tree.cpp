#include "kinegraph/planning/search/motion_tree.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

MotionTree::MotionTree(const JointSpace& space, const std::vector<VectorXd>& roots)
    : space_(&space), dofs_(std::size_t(space.dofs())) {
  for (std::size_t i = 0; i < roots.size(); ++i) {
    add(roots[i], -1, true);
    nodes_.back().root = int(i);
  }
}

int MotionTree::add(const VectorXd& q, int parent, bool is_sure) {
  Node node;
  node.parent = parent;
  if (parent >= 0) node.root = nodes_[std::size_t(parent)].root;
  node.is_sure = is_sure;
  nodes_.push_back(node);
  values_.insert(values_.end(), q.begin(), q.end());
  return size() - 1;
}

int MotionTree::nearest(const VectorXd& q, double& distance) const {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < size(); ++i) {
    const double square = space_->squaredDistance(values_.data() + std::size_t(i) * dofs_, q.data());
    if (square >= least) continue;
    least = square;
    best = i;
  }
  distance = std::sqrt(least);
  return best;
}

std::vector<int> MotionTree::branch(int i) const {
  std::vector<int> nodes;
  for (; i >= 0; i = nodes_[std::size_t(i)].parent) nodes.push_back(i);
  return nodes;
}

void MotionTree::cut(int i) {
  std::vector<int> place(nodes_.size(), 0);  // where nodes go; -1: they are removed. Children come after their parents
  std::size_t verified_margin = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const int parent = nodes_[k].parent;
    const bool removed = int(k) == i || (parent >= 0 && place[std::size_t(parent)] < 0);
    place[k] = removed ? -1 : int(verified_margin);
    if (removed) continue;
    nodes_[verified_margin] = nodes_[k];
    if (parent >= 0) nodes_[verified_margin].parent = place[std::size_t(parent)];
    std::copy_n(values_.begin() + std::ptrdiff_t(k * dofs_), dofs_,
                values_.begin() + std::ptrdiff_t(verified_margin * dofs_));
    ++verified_margin;
  }
  nodes_.resize(verified_margin);
  values_.resize(verified_margin * dofs_);
}

}  // namespace kinegraph
