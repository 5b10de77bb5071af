#include "kinegraph/planning/search/tree_search.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr double kFirstRadius = 4., kLeastRadius = 1., kRadiusRate = 1e-4;  // of the dynamic domain
constexpr int kSurprises = 4;   // after these, motions are checked at all times before they are added
constexpr int kAskEvery = 16;   // draws
constexpr int kNearEvery = 16;  // draws; of these, those that nothing grows to are drawn near the tree instead

/// A posture within the radius of one of the tree's. Where all that a tree has is next to obstacles, as in a narrow passage
/// or a space of many dofs, hardly a posture of the whole space is near enough to grow to.
VectorXd sampleNear(const MotionTree& tree, const JointSpace& space, Rng& rng) {
  const int i = std::min(int(rng.uniform(0., tree.size())), tree.size() - 1);
  const double radius = std::min(tree.node(i).radius, kFirstRadius);
  const VectorXd from = tree.q(i), away = space.difference(from, space.sample(rng, from));
  VectorXd q = from + rng.uniform(0., radius) / std::max(away.norm(), 1e-9) * away;
  space.clamp(q);
  space.normalize(q);
  return q;
}

}  // namespace

TreeSearch::TreeSearch(Steering& steering, const std::vector<VectorXd>& starts, const std::vector<VectorXd>& goals,
                       const Options& options)
    : steering_(steering),
      options_(options),
      rng_(options.seed),
      trees_{{steering.space(), starts}, {steering.space(), goals}},
      evaluations_before_(steering.evaluations()) {}

bool TreeSearch::run(const std::function<bool()>& stop) {
  while (evaluations() < options_.evaluations) {
    if (draws_ % kAskEvery == 0 && stop()) return false;
    ++draws_;
    if (grow()) return true;
  }
  return false;
}

bool TreeSearch::grow() {
  if (trees_[growing_].size() * 2 > trees_[1 - growing_].size()) growing_ = 1 - growing_;
  MotionTree &tree = trees_[growing_], &other = trees_[1 - growing_];
  VectorXd target = steering_.space().sample(rng_, tree.q(0));
  if (steering_.isConstrained() && !steering_.manifold().project(target)) return false;
  double distance = 0.;
  int near = tree.nearest(target, distance);
  if (distance > tree.node(near).radius && draws_ % kNearEvery == 0) {
    target = sampleNear(tree, steering_.space(), rng_);
    if (steering_.isConstrained() && !steering_.manifold().project(target)) return false;
    near = tree.nearest(target, distance);
  }
  if (distance == 0. || tree.node(near).radius < distance) return false;
  bool reached = false;
  const int added = extend(tree, near, target, reached);
  double& radius = tree.node(near).radius;
  const bool tight = std::isfinite(radius);
  if (added == near) {
    radius = tight ? std::max(radius * (1. - kRadiusRate), kLeastRadius) : kFirstRadius;
    return false;
  }
  if (tight) radius *= 1. + kRadiusRate;
  // As far as it comes towards the other tree.
  const int meeting = other.nearest(tree.q(added), distance);
  const VectorXd meeting_q = other.q(meeting);
  int tip = added;
  for (bool met = false; !met;) {
    const int next = extend(tree, tip, meeting_q, met);
    if (next == tip) return false;
    tip = next;
  }
  return join(tip, meeting);
}

/// Adds the way from a node towards a posture; the last node that was added, or the same one.
int TreeSearch::extend(MotionTree& tree, int from, const VectorXd& target, bool& reached) {
  const VectorXd begin = tree.q(from);
  const Steering::Way way = steering_.towards(begin, target, options_.range);
  reached = way.reached;
  const bool check = surprises_ >= kSurprises;
  VectorXd before = begin;
  for (const VectorXd& point : way.points) {
    if (check && !steering_.check().isMotionFree(before, point)) {
      reached = false;
      return from;
    }
    from = tree.add(point, from, check);
    before = point;
  }
  return from;
}

/// The growing tree has a node where the other one has one, too: a way, if all its motions are free at all times.
bool TreeSearch::join(int mine, int other) {
  const std::vector<int> branch = trees_[growing_].branch(mine), rest = trees_[1 - growing_].branch(other);
  if (!makeSure(trees_[growing_], branch) || !makeSure(trees_[1 - growing_], rest)) return false;
  path_.clear();
  for (auto i = branch.rbegin(); i != branch.rend(); ++i) path_.push_back(trees_[growing_].q(*i));
  for (std::size_t i = 1; i < rest.size(); ++i) path_.push_back(trees_[1 - growing_].q(rest[i]));
  if (growing_ == 1) std::reverse(path_.begin(), path_.end());
  start_ = trees_[0].node(growing_ == 0 ? mine : other).root;
  goal_ = trees_[1].node(growing_ == 1 ? mine : other).root;
  return true;
}

/// Checks the motions of a branch, from its root on, and cuts off what is behind the first one that is not free.
bool TreeSearch::makeSure(MotionTree& tree, const std::vector<int>& branch) {
  for (auto i = branch.rbegin(); i != branch.rend(); ++i) {
    MotionTree::Node& node = tree.node(*i);
    if (node.is_sure) continue;
    // Trees of goals grow backwards; the motion is the same one.
    if (steering_.check().isMotionFree(tree.q(node.parent), tree.q(*i))) {
      node.is_sure = true;
      continue;
    }
    ++surprises_;
    tree.cut(*i);
    return false;
  }
  return true;
}

}  // namespace kinegraph
