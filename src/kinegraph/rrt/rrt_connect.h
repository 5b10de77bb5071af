#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>

#include "kinegraph/rrt/search_space.h"
#include "kinegraph/rrt/search_tree.h"

namespace kinegraph::inline rrt_internal {

struct RrtConnectOptions {
  double range = 1.;           ///< longest edge of an extension, in the distance of the space
  double dynamic_radius = 4.;  ///< radius of a node's domain after its first failed extension
  double least_radius = 1.;    ///< least radius of that domain
  std::uint64_t seed = 0;
  long max_evaluations = 100000;                        ///< samples and evaluations of the space, together
  long max_samples = std::numeric_limits<long>::max();  ///< iterations
};

/// A bidirectional search by two trees for a path from one of several starts to one of several goals.
///
/// RRT-Connect with balanced trees: the smaller tree is extended towards a random sample, and from there, as far as it
/// gets, towards the nearest node of the other tree. Dynamic domain: a node whose extension failed is extended only
/// towards samples within its radius. If the space does not verify extensions, the edges of a candidate path are
/// verified when the trees meet; an edge that fails is cut off, and the search continues.
///
/// Sources: Kuffner, LaValle, RRT-Connect, 2000; Yershova, Jaillet, Simeon, LaValle, Dynamic-domain RRTs, 2005;
/// Thomason, Kingston, Kavraki, Motions in microseconds via vectorized sampling-based planning, 2024.
template <SearchSpace Space>
class RrtConnect {
 public:
  /// `space` must outlive the search. Starts and goals are collision-free.
  RrtConnect(Space& space, const std::vector<VectorXd>& starts, const std::vector<VectorXd>& goals,
             const RrtConnectOptions& options)
      : space_(space),
        options_(options),
        rng_(options.seed),
        trees_{{space.dofs(), starts}, {space.dofs(), goals}},
        evaluations_before_(space.evaluations()) {}

  /// Returns true if it found a path. Polls `stop` every few samples; true ends the search.
  bool run(const std::function<bool()>& stop) {
    while (evaluations() < options_.max_evaluations && samples_ < options_.max_samples) {
      if (samples_ % kPollEvery == 0 && stop()) return false;
      ++samples_;
      if (grow()) return true;
    }
    return false;
  }

  /// The configurations of the path, from a start to a goal.
  const std::vector<VectorXd>& path() const { return path_; }
  int start() const { return start_; }  ///< number of the start that the path begins at
  int goal() const { return goal_; }

  long evaluations() const { return samples_ + space_.evaluations() - evaluations_before_; }
  long samples() const { return samples_; }
  const SearchTree& tree(bool of_goals) const { return trees_[of_goals]; }

 private:
  static constexpr double kRadiusRate = 1e-4;  // change of a radius after an extension
  static constexpr int kMostCuts = 4;          // of edges; from then on extensions are verified at once
  static constexpr int kPollEvery = 16;        // samples
  static constexpr int kNearEvery = 16;        // samples; every so many, one that extends nothing is replaced

  /// Samples near a random node. If all nodes of a tree lie close to obstacles, as in a narrow passage or a space of
  /// many dofs, hardly a uniform sample is within any node's domain.
  std::optional<VectorXd> sampleNear(const SearchTree& tree) {
    const int i = std::min(int(rng_.uniform(0., tree.size())), tree.size() - 1);
    return space_.sampleNear(rng_, tree.q(i), std::min(tree.node(i).radius, options_.dynamic_radius));
  }

  bool grow() {
    if (trees_[growing_].size() * 2 > trees_[1 - growing_].size()) growing_ = 1 - growing_;
    SearchTree &tree = trees_[growing_], &other = trees_[1 - growing_];
    std::optional<VectorXd> target = space_.sample(rng_, tree.q(0));
    if (!target) return false;
    double distance = 0.;
    int near = tree.nearest(space_, *target, distance);
    if (distance > tree.node(near).radius && samples_ % kNearEvery == 0) {
      target = sampleNear(tree);
      if (!target) return false;
      near = tree.nearest(space_, *target, distance);
    }
    if (distance == 0. || tree.node(near).radius < distance) return false;
    bool reached = false;
    const int added = extend(tree, near, *target, reached);
    double& radius = tree.node(near).radius;
    const bool is_limited = std::isfinite(radius);
    if (added == near) {
      radius = is_limited ? std::max(radius * (1. - kRadiusRate), options_.least_radius) : options_.dynamic_radius;
      return false;
    }
    if (is_limited) radius *= 1. + kRadiusRate;
    const int meeting = other.nearest(space_, tree.q(added), distance);
    const VectorXd meeting_q = other.q(meeting);
    int tip = added;
    for (bool met = false; !met;) {
      const int next = extend(tree, tip, meeting_q, met);
      if (next == tip) return false;
      tip = next;
    }
    return join(tip, meeting);
  }

  /// Extends a tree from a node towards a target. Returns the last added node, or `from` if there is none.
  int extend(SearchTree& tree, int from, const VectorXd& target, bool& reached) {
    const VectorXd begin = tree.q(from);
    const Extension extension = space_.extend(begin, target, options_.range);
    reached = extension.reached;
    const bool verifies = !Space::kVerifiesExtensions && cuts_ >= kMostCuts;
    VectorXd before = begin;
    for (const VectorXd& point : extension.points) {
      if (verifies && !space_.isEdgeFree(before, point)) {
        reached = false;
        return from;
      }
      from = tree.add(point, from, Space::kVerifiesExtensions || verifies);
      before = point;
    }
    return from;
  }

  /// Makes a path of the branches to two nodes with the same configuration, if all their edges are verified.
  bool join(int mine, int other) {
    const std::vector<int> branch = trees_[growing_].branch(mine), rest = trees_[1 - growing_].branch(other);
    if (!verify(trees_[growing_], branch) || !verify(trees_[1 - growing_], rest)) return false;
    path_.clear();
    for (auto i = branch.rbegin(); i != branch.rend(); ++i) path_.push_back(trees_[growing_].q(*i));
    for (std::size_t i = 1; i < rest.size(); ++i) path_.push_back(trees_[1 - growing_].q(rest[i]));
    if (growing_ == 1) std::reverse(path_.begin(), path_.end());
    start_ = trees_[0].node(growing_ == 0 ? mine : other).root;
    goal_ = trees_[1].node(growing_ == 1 ? mine : other).root;
    return true;
  }

  /// Verifies the edges of a branch from its root on, and cuts the tree at the first one that is not free.
  bool verify(SearchTree& tree, const std::vector<int>& branch) {
    for (auto i = branch.rbegin(); i != branch.rend(); ++i) {
      SearchTree::Node& node = tree.node(*i);
      if (node.is_verified) continue;
      // Trees of goals grow backwards; the edge is the same one.
      if (space_.isEdgeFree(tree.q(node.parent), tree.q(*i))) {
        node.is_verified = true;
        continue;
      }
      ++cuts_;
      tree.cut(*i);
      return false;
    }
    return true;
  }

  Space& space_;
  RrtConnectOptions options_;
  Rng rng_;
  SearchTree trees_[2];
  int growing_ = 1;
  long samples_ = 0, evaluations_before_;
  int cuts_ = 0;  ///< edges that an extension found free and that are not
  std::vector<VectorXd> path_;
  int start_ = 0, goal_ = 0;
};

}  // namespace kinegraph::inline rrt_internal
