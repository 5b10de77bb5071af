#include "kinegraph/planning/smoothing/shortcut.h"

#include <algorithm>

namespace kinegraph {

namespace {

constexpr double kWorth = 1e-3;  // least gain, as a share of the length
constexpr int kCornerRounds = 8;
constexpr int kMostMisses = 60;  // random joints that gain nothing

class Shortcutter {
 public:
  Shortcutter(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options)
      : steering_(steering), path_(std::move(path)), options_(options), rng_(options.seed) {}

  std::vector<VectorXd> run() {
    joinConfigurations();
    joinPlaces();
    if (options_.corners) {
      cutCorners();
      joinConfigurations();
    }
    return std::move(path_);
  }

 private:
  double distance(const VectorXd& a, const VectorXd& b) const {
    const VectorXd change = steering_.space().difference(a, b);
    return options_.weight.size() > 0 ? change.cwiseProduct(options_.weight).norm() : change.norm();
  }

  double length(const std::vector<VectorXd>& points) const {
    double sum = 0.;
    for (std::size_t i = 1; i < points.size(); ++i) sum += distance(points[i - 1], points[i]);
    return sum;
  }

  bool stopped() const { return options_.cancellation && options_.cancellation(); }

  /// Replaces what is between two places, i < j, if there is a free way that is shorter.
  bool join(std::size_t i, std::size_t j) {
    const std::vector<VectorXd> before(path_.begin() + std::ptrdiff_t(i), path_.begin() + std::ptrdiff_t(j) + 1);
    const double old = length(before);
    if (distance(path_[i], path_[j]) > old * (1. - 1e-9)) return false;
    const auto way = steering_.between(path_[i], path_[j]);
    if (!way) return false;
    std::vector<VectorXd> after = {path_[i]};
    after.insert(after.end(), way->begin(), way->end());
    after.push_back(path_[j]);
    if (length(after) >= old) return false;
    path_.erase(path_.begin() + std::ptrdiff_t(i) + 1, path_.begin() + std::ptrdiff_t(j));
    path_.insert(path_.begin() + std::ptrdiff_t(i) + 1, way->begin(), way->end());
    return true;
  }

  void joinConfigurations() {
    for (std::size_t i = 0; i + 2 < path_.size(); ++i) {
      if (stopped()) return;
      for (std::size_t j = path_.size() - 1; j > i + 1; --j)
        if (join(i, j)) break;
    }
  }

  /// A new posture `along` a path of given length; the place of the one behind it.
  std::size_t split(double along) {
    std::size_t k = 1;
    for (; k + 1 < path_.size(); ++k) {
      const double piece = distance(path_[k - 1], path_[k]);
      if (along <= piece) break;
      along -= piece;
    }
    const double piece = distance(path_[k - 1], path_[k]);
    VectorXd q = path_[k - 1] + (piece > 0. ? std::clamp(along / piece, 0., 1.) : 0.) *
                                    steering_.space().difference(path_[k - 1], path_[k]);
    steering_.space().normalize(q);
    path_.insert(path_.begin() + std::ptrdiff_t(k), q);
    return k;
  }

  /// Random pairs of places, at first anywhere, later nearer to each other.
  void joinPlaces() {
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
      bool same_piece = true;  // between places on one straight motion nothing is gained
      for (std::size_t k = a + 1; k < b; ++k) same_piece = false;
      if (same_piece || !join(a, b)) {
        path_ = before;
        continue;
      }
      dropUseless();
      if (length(path_) < (1. - kWorth) * all) misses = 0;
      all = length(path_);
    }
  }

  /// Removes postures on the straight line between their neighbors.
  void dropUseless() {
    if (steering_.isConstrained()) return;
    for (std::size_t i = 1; i + 1 < path_.size();) {
      const double around = distance(path_[i - 1], path_[i]) + distance(path_[i], path_[i + 1]);
      if (around - distance(path_[i - 1], path_[i + 1]) > 1e-12 * (1. + around)) {
        ++i;
      } else {
        path_.erase(path_.begin() + std::ptrdiff_t(i));
      }
    }
  }

  /// Each corner is replaced by two places before and behind it, as far away as is free.
  void cutCorners() {
    if (steering_.isConstrained()) return;
    for (int round = 0; round < kCornerRounds; ++round) {
      const double before = length(path_);
      for (std::size_t i = 1; i + 1 < path_.size(); ++i) {
        if (stopped()) return;
        i += cutCorner(i);
      }
      dropUseless();
      if (length(path_) > (1. - kWorth) * before) return;
    }
  }

  /// How many postures were added.
  std::size_t cutCorner(std::size_t i) {
    const VectorXd corner = path_[i], to_before = steering_.space().difference(corner, path_[i - 1]),
                   to_next = steering_.space().difference(corner, path_[i + 1]);
    for (const double share : {.5, .25, .1}) {
      VectorXd a = corner + share * to_before, b = corner + share * to_next;
      steering_.space().normalize(a);
      steering_.space().normalize(b);
      if (!steering_.between(a, b)) continue;
      path_[i] = a;
      path_.insert(path_.begin() + std::ptrdiff_t(i) + 1, b);
      return 1;
    }
    return 0;
  }

  Steering& steering_;
  std::vector<VectorXd> path_;
  const ShortcutOptions& options_;
  Rng rng_;
};

}  // namespace

std::vector<VectorXd> shorten(Steering& steering, std::vector<VectorXd> path, const ShortcutOptions& options) {
  return Shortcutter(steering, std::move(path), options).run();
}

}  // namespace kinegraph
