#pragma once

#include <limits>
#include <vector>

#include "kinegraph/planning/steering/joint_space.h"

namespace kinegraph {

/// Postures that can be reached from a root, each by a straight motion from its parent. There may be several roots.
class MotionTree {
 public:
  struct Node {
    int parent = -1;                                          ///< -1: a root
    int root = 0;                                             ///< which one it hangs on, in the order of the roots
    double radius = std::numeric_limits<double>::infinity();  ///< draws farther away do not grow from here
    bool is_sure = true;  ///< the motion from its parent is free at all times, as far as is known
  };

  /// `space` must stay.
  MotionTree(const JointSpace& space, const std::vector<VectorXd>& roots);

  int size() const { return int(nodes_.size()); }
  Node& node(int i) { return nodes_[std::size_t(i)]; }
  const Node& node(int i) const { return nodes_[std::size_t(i)]; }
  Eigen::Map<const VectorXd> q(int i) const { return {values_.data() + std::size_t(i) * dofs_, Eigen::Index(dofs_)}; }

  int add(const VectorXd& q, int parent, bool is_sure);

  /// The node nearest to q, the first of equals, and how far that is.
  int nearest(const VectorXd& q, double& distance) const;

  /// From a node to its root.
  std::vector<int> branch(int i) const;

  /// Removes a node that is no root, and all that hang on it. Numbers of nodes change.
  void cut(int i);

 private:
  const JointSpace* space_;
  std::size_t dofs_;
  std::vector<double> values_;
  std::vector<Node> nodes_;
};

}  // namespace kinegraph
