#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Statistics of one tree search.
struct SearchReport {
  long samples = 0, evaluations = 0;
  int start_nodes = 0, goal_nodes = 0;
};

/// Configurations that a search reached from one or several roots, each by a straight edge from its parent.
class SearchTree {
 public:
  struct Node {
    int parent = -1;                                          ///< -1: a root
    int root = 0;                                             ///< number of the root that the node descends from
    double radius = std::numeric_limits<double>::infinity();  ///< samples farther away do not extend this node
    bool is_verified = true;  ///< the edge from the parent is known to be continuously collision-free
  };

  /// A tree of configurations with `dofs` entries. The roots are its first nodes, in their order.
  SearchTree(int dofs, const std::vector<VectorXd>& roots);

  int size() const { return int(nodes_.size()); }
  Node& node(int i) { return nodes_[std::size_t(i)]; }
  const Node& node(int i) const { return nodes_[std::size_t(i)]; }
  Eigen::Map<const VectorXd> q(int i) const { return {values_.data() + std::size_t(i) * dofs_, Eigen::Index(dofs_)}; }

  /// Adds a node and returns its number.
  int add(const VectorXd& q, int parent, bool is_verified);

  /// Returns the node nearest to q, the first of equally near ones, and writes its distance. `space` has
  /// `squaredDistance(const double*, const double*)`.
  template <class Space>
  int nearest(const Space& space, const VectorXd& q, double& distance) const {
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < size(); ++i) {
      const double square = space.squaredDistance(values_.data() + std::size_t(i) * dofs_, q.data());
      if (square >= least) continue;
      least = square;
      best = i;
    }
    distance = std::sqrt(least);
    return best;
  }

  /// Returns the nodes from node i to its root.
  std::vector<int> branch(int i) const;

  /// Removes a node that is no root, and its descendants. The remaining nodes are renumbered.
  void cut(int i);

 private:
  std::size_t dofs_;
  std::vector<double> values_;
  std::vector<Node> nodes_;
};

}  // namespace kinegraph
