#pragma once

#include <algorithm>
#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/rrt/search_space.h"

namespace kinegraph::inline rrt_internal {

struct ShortcutOptions {
  VectorXd weight = {};    ///< per dof, of the weighted length that is reduced; empty: ones
  int cuts = 200;          ///< random shortcuts that are tried
  bool corners = true;     ///< also replaces corners by edges across them
  std::uint64_t seed = 0;  ///< of the random shortcuts
  CancellationToken cancellation = {};
};

/// Shortens a path whose edges are valid by shortcuts that are valid, too: first between its configurations, then
/// between random points, which come closer to each other with every try, and then across its corners. Both ends stay.
/// On constrained spaces a shortcut is a path along the manifold, and corners stay.
/// Source: Geraerts, Overmars, Creating high-quality paths for motion planning, 2007.
template <SearchSpace Space>
class Shortcutter {
 public:
  Shortcutter(Space& space, std::vector<VectorXd> path, const ShortcutOptions& options)
      : space_(space), path_(std::move(path)), options_(options), rng_(options.seed) {}

  std::vector<VectorXd> run() {
    connectConfigurations();
    connectRandomPoints();
    if (options_.corners) {
      cutCorners();
      connectConfigurations();
    }
    return std::move(path_);
  }

 private:
  static constexpr double kLeastGain = 1e-3;  // of a round or try that counts, as a share of the length
  static constexpr int kCornerRounds = 8;
  static constexpr int kMostMisses = 60;  // random shortcuts in a row that gain nothing

  double distance(const VectorXd& a, const VectorXd& b) const {
    const VectorXd change = space_.difference(a, b);
    return options_.weight.size() > 0 ? change.cwiseProduct(options_.weight).norm() : change.norm();
  }

  double length(const std::vector<VectorXd>& points) const {
    double sum = 0.;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
  }

  bool stopped() const { return options_.cancellation && options_.cancellation(); }

  /// Replaces the path between points i < j by a valid connection that is shorter. False if there is none.
  bool shortcut(std::size_t i, std::size_t j) {
    const std::vector<VectorXd> before(path_.begin() + std::ptrdiff_t(i), path_.begin() + std::ptrdiff_t(j) + 1);
    const double old = length(before);
    if (distance(path_[i], path_[j]) > old * (1. - 1e-9)) return false;
    const auto between = space_.connect(path_[i], path_[j]);
    if (!between) return false;
    std::vector<VectorXd> after = {path_[i]};
    after.insert(after.end(), between->begin(), between->end());
    after.push_back(path_[j]);
    if (length(after) >= old) return false;
    path_.erase(path_.begin() + std::ptrdiff_t(i) + 1, path_.begin() + std::ptrdiff_t(j));
    path_.insert(path_.begin() + std::ptrdiff_t(i) + 1, between->begin(), between->end());
    return true;
  }

  /// Connects each configuration to the last one to which a shortcut is found.
  void connectConfigurations() {
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      if (stopped()) return;
      for (std::size_t j = path_.size() - 1; j > i + 1; --j)
        if (shortcut(i, j)) break;
    }
  }

  /// Inserts the point at a length `along` the path, and returns its index.
  std::size_t split(double along) {
    std::size_t k = 1;
    for (; k + 1 < path_.size(); ++k) {
      const double piece = distance(path_[k - 1], path_[k]);
      if (along <= piece) break;
      along -= piece;
    }
    const double piece = distance(path_[k - 1], path_[k]);
    VectorXd q = path_[k - 1] +
                 (piece > 0. ? std::clamp(along / piece, 0., 1.) : 0.) * space_.difference(path_[k - 1], path_[k]);
    space_.normalize(q);
    path_.insert(path_.begin() + std::ptrdiff_t(k), q);
    return k;
  }

  void connectRandomPoints() {
    double all = length(path_);
    int misses = 0;  // in a row
    for (int i = 0; i < options_.cuts && path_.size() > 2 && misses < kMostMisses; ++i) {
      ++misses;
      if (i % 8 == 0 && stopped()) return;
      const double reach = all * (1. - .9 * i / options_.cuts), first = rng_.uniform(0., all),
                   second = first + reach * rng_.uniform(.1, 1.);
      if (second >= all) continue;
      const std::vector<VectorXd> before = path_;
      const std::size_t a = split(first), b = split(second);
      const bool same_piece = b <= a + 1;  // between points on one edge nothing is gained
      if (same_piece || !shortcut(a, b)) {
        path_ = before;
        continue;
      }
      dropStraight();
      if (length(path_) < (1. - kLeastGain) * all) misses = 0;
      all = length(path_);
    }
  }

  /// Removes configurations on the straight edge between their neighbors.
  void dropStraight() {
    if (space_.isConstrained()) return;
    for (std::size_t i = 1; i + 1 < path_.size();) {
      const double around = distance(path_[i - 1], path_[i]) + distance(path_[i], path_[i + 1]);
      if (around - distance(path_[i - 1], path_[i + 1]) > 1e-12 * (1. + around)) {
        ++i;
      } else {
        path_.erase(path_.begin() + std::ptrdiff_t(i));
      }
    }
  }

  void cutCorners() {
    if (space_.isConstrained()) return;
    for (int round = 0; round < kCornerRounds; ++round) {
      const double before = length(path_);
      for (std::size_t i = 1; i + 1 < path_.size(); ++i) {
        if (stopped()) return;
        i += cutCorner(i);
      }
      dropStraight();
      if (length(path_) > (1. - kLeastGain) * before) return;
    }
  }

  /// Replaces a corner by two points before and behind it, as far away as is valid. Returns the number of added points.
  std::size_t cutCorner(std::size_t i) {
    const VectorXd corner = path_[i], to_before = space_.difference(corner, path_[i - 1]),
                   to_next = space_.difference(corner, path_[i + 1]);
    for (const double share : {.5, .25, .1}) {
      VectorXd a = corner + share * to_before, b = corner + share * to_next;
      space_.normalize(a);
      space_.normalize(b);
      if (!space_.connect(a, b)) continue;
      path_[i] = a;
      path_.insert(path_.begin() + std::ptrdiff_t(i) + 1, b);
      return 1;
    }
    return 0;
  }

  Space& space_;
  std::vector<VectorXd> path_;
  const ShortcutOptions& options_;
  Rng rng_;
};

}  // namespace kinegraph::inline rrt_internal
