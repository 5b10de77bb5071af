#include "kinegraph/tool_paths/path_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace kinegraph::inline tool_paths_internal {

namespace {

constexpr int kMaxImprovements = 200;
constexpr int kMaxRounds = 13;  // orders whose transfers are planned
constexpr double kNever = std::numeric_limits<double>::infinity();

/// The best choice of variants for an order, and orders.
class OrderSearch {
 public:
  explicit OrderSearch(const OrderProblem& problem) : problem_(problem) {
    first_.push_back(0);
    for (const std::vector<PathVariant>& of_path : problem.variants) {
      first_.push_back(first_.back() + int(of_path.size()));
      for (const PathVariant& variant : of_path) duration_.push_back(variant.duration);
    }
  }

  int firstVariant(int path) const { return first_[std::size_t(path)]; }
  int paths() const { return int(problem_.variants.size()); }

  /// The least duration of all paths and transfers in an order; `chosen` receives the variants.
  double costOf(const std::vector<int>& order, std::vector<int>* chosen = nullptr) const {
    std::vector<double> cost, next;
    std::vector<std::vector<int>> before(order.size());
    for (int b = first_[std::size_t(order[0])]; b < first_[std::size_t(order[0]) + 1]; ++b)
      cost.push_back(problem_.begin[b] + duration_[std::size_t(b)]);
    for (std::size_t k = 1; k < order.size(); ++k) {
      next.clear();
      const int a0 = first_[std::size_t(order[k - 1])];
      for (int b = first_[std::size_t(order[k])]; b < first_[std::size_t(order[k]) + 1]; ++b) {
        double best = std::numeric_limits<double>::infinity();
        int from = 0;
        for (int a = 0; a < int(cost.size()); ++a)
          if (cost[std::size_t(a)] + problem_.transfer(a0 + a, b) < best)
            best = cost[std::size_t(a)] + problem_.transfer(a0 + a, b), from = a;
        next.push_back(best + duration_[std::size_t(b)]);
        before[k].push_back(from);
      }
      cost = next;
    }
    const int last = int(std::min_element(cost.begin(), cost.end()) - cost.begin());
    if (chosen) {
      chosen->assign(order.size(), last);
      for (std::size_t k = order.size(); k-- > 1;) (*chosen)[k - 1] = before[k][std::size_t((*chosen)[k])];
    }
    return cost[std::size_t(last)];
  }

  /// The order of nearest neighbors that begins with a path.
  std::vector<int> nearestFrom(int path) const {
    std::vector<int> order = {path};
    std::vector<char> done(std::size_t(paths()), 0);
    done[std::size_t(path)] = 1;
    while (int(order.size()) < paths()) {
      double best = std::numeric_limits<double>::infinity();
      int next = -1;
      for (int k = 0; k < paths(); ++k) {
        if (done[std::size_t(k)]) continue;
        const double least = problem_.transfer
                                 .block(first_[std::size_t(order.back())], first_[std::size_t(k)],
                                        first_[std::size_t(order.back()) + 1] - first_[std::size_t(order.back())],
                                        first_[std::size_t(k) + 1] - first_[std::size_t(k)])
                                 .minCoeff();
        if (next < 0 || least < best) best = least, next = k;
      }
      order.push_back(next);
      done[std::size_t(next)] = 1;
    }
    return order;
  }

  /// Reverses and moves parts of an order while that makes it shorter.
  double improve(std::vector<int>& order) const {
    double cost = costOf(order);
    for (int round = 0; round < kMaxImprovements; ++round) {
      double best = cost - 1e-12;
      std::vector<int> better;
      const auto consider = [&](std::vector<int> other) {
        const double c = costOf(other);
        if (c < best) best = c, better = std::move(other);
      };
      for (std::size_t a = 0; a < order.size(); ++a)
        for (std::size_t b = a + 1; b < order.size(); ++b) {
          std::vector<int> other = order;
          std::reverse(other.begin() + std::ptrdiff_t(a), other.begin() + std::ptrdiff_t(b) + 1);
          consider(std::move(other));
          for (const bool forward : {true, false}) {  // one path to another position
            std::vector<int> moved = order;
            const auto first = moved.begin() + std::ptrdiff_t(a), last = moved.begin() + std::ptrdiff_t(b);
            forward ? std::rotate(first, first + 1, last + 1) : std::rotate(first, last, last + 1);
            consider(std::move(moved));
          }
        }
      if (better.empty()) break;
      order = std::move(better), cost = best;
    }
    return cost;
  }

 private:
  const OrderProblem& problem_;
  std::vector<int> first_;        ///< per path: index of its first variant
  std::vector<double> duration_;  ///< per variant, s
};

/// The least time (s) from rest to rest over a distance within limits of velocity, acceleration and jerk.
double restToRest(double distance, double velocity, double acceleration, double jerk) {
  const double full = acceleration * acceleration / jerk;  // the speed from which the acceleration reaches its limit
  const auto ramp = [&](double speed) {
    return speed < full ? 2. * std::sqrt(speed / jerk) : speed / acceleration + acceleration / jerk;
  };
  if (!std::isfinite(velocity) || distance < velocity * ramp(velocity)) {
    double peak = std::cbrt(.25 * distance * distance * jerk);
    if (!(peak < full)) {
      const double rise = acceleration / jerk;
      peak = .5 * acceleration * (std::sqrt(rise * rise + 4. * distance / acceleration) - rise);
    }
    return 2. * ramp(peak);
  }
  return distance / velocity + ramp(velocity);
}

/// One orderWithTransfers call.
class SequenceSearch {
 public:
  SequenceSearch(std::vector<std::vector<PathVariant>> variants, bool free_order, const std::optional<VectorXd>& from,
                 const MotionLimits& limits, const TransferPlanner& plan)
      : from_(from), plan_(plan) {
    problem_.variants = std::move(variants), problem_.free_order = free_order;
    for (const std::vector<PathVariant>& of_path : problem_.variants) {
      const int first = int(all_.size());
      for (const PathVariant& variant : of_path) {
        all_.push_back(&variant);
        part_.push_back(first + variant.solution);
      }
    }
    const Eigen::Index count = Eigen::Index(all_.size());
    part_.push_back(int(count));  // where the robot is
    problem_.transfer.resize(count, count);
    problem_.begin = VectorXd::Zero(count);
    for (Eigen::Index b = 0; b < count; ++b) {
      const VectorXd& to = all_[std::size_t(b)]->first;
      for (Eigen::Index a = 0; a < count; ++a)
        problem_.transfer(a, b) = leastTransfer(all_[std::size_t(a)]->last, to, limits);
      if (from_) problem_.begin[b] = leastTransfer(*from_, to, limits);
    }
  }

  PathSequence run() {
    PathSequence best;
    double least = kNever;
    const bool free_order = problem_.free_order;
    for (int round = 0; round < kMaxRounds; ++round) {
      problem_.free_order = free_order && round > 0;  // the given order is the first one
      PathSequence sequence{orderPaths(problem_), {}, false};
      bool any_new = false;
      const double total = planTransfers(sequence, any_new);
      if (total < least || best.order.empty()) best = std::move(sequence), least = total;
      if (!any_new && (round > 0 || !free_order)) break;
      problem_.near_order.clear();
      if (std::isfinite(total) && round > 0)
        for (const OrderedPath& path : best.order) problem_.near_order.push_back(path.path);
    }
    best.feasible = std::isfinite(least);
    return best;
  }

 private:
  /// Plans the transfers of a sequence that are not known, up to the first that does not exist. Returns the duration of
  /// all, with the paths, s.
  double planTransfers(PathSequence& sequence, bool& any_new) {
    double total = 0.;
    int before = -1;
    for (const OrderedPath& path : sequence.order) {
      sequence.transfers.emplace_back();
      total += all_[std::size_t(path.variant)]->duration;
      if (before >= 0 || from_) {
        const auto [known, is_new] = planned_.try_emplace({before, path.variant});
        if (is_new) {
          any_new = true;
          planTransfer(before, path.variant, known->second);
        }
        sequence.transfers.back() = known->second;
        total += before < 0 ? problem_.begin[path.variant] : problem_.transfer(before, path.variant);
        if (!std::isfinite(total)) return total;
      }
      before = path.variant;
    }
    return total;
  }

  void planTransfer(int before, int variant, std::optional<MotionPlan>& plan) {
    const VectorXd &start = before < 0 ? *from_ : all_[std::size_t(before)]->last,
                   &end = all_[std::size_t(variant)]->first;
    double& duration = before < 0 ? problem_.begin[variant] : problem_.transfer(before, variant);
    if (!std::isfinite(duration)) return;  // barred
    if ((end - start).cwiseAbs().maxCoeff() < kSameConfiguration) {
      duration = 0.;
      return;
    }
    plan = plan_(start, end);
    const int a = part_[before < 0 ? all_.size() : std::size_t(before)], b = part_[std::size_t(variant)];
    if (plan->feasible()) {
      duration = plan->duration();
      for (int& part : part_)
        if (part == b) part = a;
    } else if (a != b) {
      bar(a, b);
    } else {
      duration = kNever;
    }
  }

  /// Bars transfers between two parts of the space, each connected by motions that are known.
  void bar(int a, int b) {
    const auto is_between = [&](int p, int q) { return (p == a && q == b) || (p == b && q == a); };
    for (std::size_t to = 0; to < all_.size(); ++to) {
      for (std::size_t from = 0; from < all_.size(); ++from)
        if (is_between(part_[from], part_[to])) problem_.transfer(Eigen::Index(from), Eigen::Index(to)) = kNever;
      if (is_between(part_.back(), part_[to])) problem_.begin[Eigen::Index(to)] = kNever;
    }
  }

  OrderProblem problem_;
  const std::optional<VectorXd>& from_;
  const TransferPlanner& plan_;
  std::vector<const PathVariant*> all_;
  std::vector<int> part_;  ///< per variant, and of the start: the part of the space that is known to be connected
  std::map<std::pair<int, int>, std::optional<MotionPlan>> planned_;
};

}  // namespace

std::vector<OrderedPath> orderPaths(const OrderProblem& problem) {
  const OrderSearch search(problem);
  std::vector<int> order = problem.near_order;
  for (int k = int(order.size()); k < search.paths(); ++k) order.push_back(k);
  if (problem.free_order && search.paths() > 1) {
    double least = std::numeric_limits<double>::infinity();
    if (!problem.near_order.empty()) least = search.improve(order);
    const int starts = problem.near_order.empty() ? std::min(search.paths(), 4) : 0;
    for (int k = 0; k < starts; ++k) {
      std::vector<int> other = search.nearestFrom(k * search.paths() / starts);
      const double cost = search.improve(other);
      if (cost < least) least = cost, order = other;
    }
  }
  std::vector<int> chosen;
  search.costOf(order, &chosen);
  std::vector<OrderedPath> result;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const PathVariant& variant = problem.variants[std::size_t(order[k])][std::size_t(chosen[k])];
    result.push_back({order[k], variant.solution, variant.reversed, search.firstVariant(order[k]) + chosen[k]});
  }
  return result;
}

double leastTransfer(const VectorXd& from, const VectorXd& to, const MotionLimits& limits) {
  double least = 0.;
  for (Eigen::Index joint = 0; joint < from.size(); ++joint)
    least = std::max(least, restToRest(std::abs(to[joint] - from[joint]), limits.velocity[joint],
                                       limits.acceleration[joint], limits.limitsJerk() ? limits.jerk[joint] : kNever));
  return least;
}

PathSequence orderWithTransfers(std::vector<std::vector<PathVariant>> variants, bool free_order,
                                const std::optional<VectorXd>& from, const MotionLimits& limits,
                                const TransferPlanner& plan) {
  return SequenceSearch(std::move(variants), free_order, from, limits, plan).run();
}

}  // namespace kinegraph::inline tool_paths_internal
