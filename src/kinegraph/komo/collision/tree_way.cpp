#include "kinegraph/komo/collision/tree_way.h"

#include <algorithm>
#include <limits>

namespace kinegraph {

namespace {

using Points = std::vector<VectorXd>;

constexpr double kRange = .25;  // of a motion that a tree grows by, as a share of the straight way
constexpr int kCuts = 40;       // random ones of what was found

struct Tree {
  Points points;
  std::vector<int> parents;

  int add(VectorXd q, int parent) {
    points.push_back(std::move(q));
    parents.push_back(parent);
    return int(points.size()) - 1;
  }

  int nearest(const VectorXd& q) const {
    int nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double square = (points[i] - q).squaredNorm();
      if (square < least) least = square, nearest = int(i);
    }
    return nearest;
  }

  /// From the root to a node.
  Points branch(int node) const {
    Points points_up;
    for (; node >= 0; node = parents[std::size_t(node)]) points_up.push_back(points[std::size_t(node)]);
    std::ranges::reverse(points_up);
    return points_up;
  }
};

class TwoTrees {
 public:
  TwoTrees(EdgeChecker& checker, const TreeBounds& room, const VectorXd& from, const VectorXd& to, Rng& rng)
      : checker_(checker), room_(room), rng_(rng), range_(kRange * (to - from).norm()) {
    trees_[0].add(from, -1);
    trees_[1].add(to, -1);
  }

  Points find(int growths) {
    for (int i = 0; i < growths; ++i) {
      const int growing = i % 2;
      Tree &tree = trees_[growing], &other = trees_[1 - growing];
      const VectorXd target = draw();
      const int tip = extend(tree, tree.nearest(target), target);
      if (tip < 0) continue;
      const VectorXd& meeting = tree.points[std::size_t(tip)];
      for (int at = other.nearest(meeting); at >= 0; at = extend(other, at, meeting)) {
        if (other.points[std::size_t(at)] == meeting) return joined(growing == 0 ? tip : at, growing == 0 ? at : tip);
      }
    }
    return {};
  }

  /// Replaces pieces of a way by straight motions: from each configuration to the last one that is reached so, and
  /// between random places of it.
  void shorten(Points& way) {
    joinFarthest(way);
    for (int i = 0; i < kCuts && way.size() > 2; ++i) cut(way);
    joinFarthest(way);
  }

 private:
  bool isFree(const VectorXd& a, const VectorXd& b) { return checker_.isFree(a.data(), b.data()); }

  VectorXd draw() {
    VectorXd q = trees_[0].points.front();
    for (std::size_t i = 0; i < room_.dofs.size(); ++i)
      q[room_.dofs[i]] = rng_.uniform(room_.lower[Eigen::Index(i)], room_.upper[Eigen::Index(i)]);
    return q;
  }

  /// The new node, as far towards the target as the range allows; -1 where the motion is not free.
  int extend(Tree& tree, int from, const VectorXd& target) {
    const VectorXd begin = tree.points[std::size_t(from)], way = target - begin;
    const double length = way.norm();
    const VectorXd end = length <= range_ ? target : VectorXd(begin + range_ / length * way);
    return isFree(begin, end) ? tree.add(end, from) : -1;
  }

  Points joined(int first, int second) const {
    Points way = trees_[0].branch(first), rest = trees_[1].branch(second);
    way.insert(way.end(), rest.rbegin() + 1, rest.rend());
    return way;
  }

  void joinFarthest(Points& way) {
    for (std::size_t i = 0; i + 2 < way.size(); ++i) {
      for (std::size_t j = way.size() - 1; j > i + 1; --j) {
        if (!isFree(way[i], way[j])) continue;
        way.erase(way.begin() + std::ptrdiff_t(i) + 1, way.begin() + std::ptrdiff_t(j));
        break;
      }
    }
  }

  void cut(Points& way) {
    const double last = double(way.size()) - 1.;
    double a = rng_.uniform(0., last), b = rng_.uniform(0., last);
    if (a > b) std::swap(a, b);
    const auto first = std::size_t(a), second = std::size_t(b);
    if (first == second) return;
    const auto at = [&](double place, std::size_t i) {
      return VectorXd(way[i] + (place - double(i)) * (way[i + 1] - way[i]));
    };
    Points ends = {at(a, first), at(b, second)};
    if (!isFree(ends[0], ends[1])) return;
    way.erase(way.begin() + std::ptrdiff_t(first) + 1, way.begin() + std::ptrdiff_t(second) + 1);
    way.insert(way.begin() + std::ptrdiff_t(first) + 1, ends.begin(), ends.end());
  }

  EdgeChecker& checker_;
  const TreeBounds& room_;
  Rng& rng_;
  double range_;
  Tree trees_[2];
};

}  // namespace

std::vector<VectorXd> treePath(EdgeChecker& checker, const TreeBounds& room, const VectorXd& from, const VectorXd& to,
                               Rng& rng, int growths) {
  VectorXd rest = to - from;
  rest(room.dofs).setZero();
  if (!rest.isZero(0.) || !checker.isFree(from.data()) || !checker.isFree(to.data())) return {};
  if (from == to) return {from, to};
  TwoTrees trees(checker, room, from, to, rng);
  Points way = trees.find(growths);
  if (!way.empty()) trees.shorten(way);
  return way;
}

}  // namespace kinegraph
