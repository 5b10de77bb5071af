#include "kinegraph/rrt/search_tree.h"

#include <algorithm>

namespace kinegraph {

SearchTree::SearchTree(int dofs, const std::vector<VectorXd>& roots) : dofs_(std::size_t(dofs)) {
  for (std::size_t i = 0; i < roots.size(); ++i) {
    add(roots[i], -1, true);
    nodes_.back().root = int(i);
  }
}

int SearchTree::add(const VectorXd& q, int parent, bool is_verified) {
  Node node;
  node.parent = parent;
  if (parent >= 0) node.root = nodes_[std::size_t(parent)].root;
  node.is_verified = is_verified;
  nodes_.push_back(node);
  values_.insert(values_.end(), q.begin(), q.end());
  return size() - 1;
}

std::vector<int> SearchTree::branch(int i) const {
  std::vector<int> nodes;
  for (; i >= 0; i = nodes_[std::size_t(i)].parent) nodes.push_back(i);
  return nodes;
}

void SearchTree::cut(int i) {
  std::vector<int> new_index(nodes_.size(), 0);  // -1: removed. Children come after their parents.
  std::size_t count = 0;                         // of the nodes that remain
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const int parent = nodes_[k].parent;
    const bool removed = int(k) == i || (parent >= 0 && new_index[std::size_t(parent)] < 0);
    new_index[k] = removed ? -1 : int(count);
    if (removed) continue;
    nodes_[count] = nodes_[k];
    if (parent >= 0) nodes_[count].parent = new_index[std::size_t(parent)];
    std::copy_n(values_.begin() + std::ptrdiff_t(k * dofs_), dofs_, values_.begin() + std::ptrdiff_t(count * dofs_));
    ++count;
  }
  nodes_.resize(count);
  values_.resize(count * dofs_);
}

}  // namespace kinegraph
