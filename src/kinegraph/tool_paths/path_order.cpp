#include "kinegraph/tool_paths/path_order.h"

#include <algorithm>
#include <limits>

namespace kinegraph {

namespace {

constexpr int kMaxImprovements = 200;

/// Costs of transfers between variants, and the best choice for an order.
class OrderSearch {
 public:
  explicit OrderSearch(const OrderProblem& problem) : problem_(problem) {
    for (const std::vector<PathVariant>& of_path : problem.variants) {
      first_.push_back(int(all_.size()));
      for (const PathVariant& variant : of_path) all_.push_back(&variant);
    }
    first_.push_back(int(all_.size()));
    cost_.resize(Eigen::Index(all_.size()), Eigen::Index(all_.size()));
    begin_ = VectorXd::Zero(Eigen::Index(all_.size()));
    for (std::size_t a = 0; a < all_.size(); ++a) {
      for (std::size_t b = 0; b < all_.size(); ++b)
        cost_(Eigen::Index(a), Eigen::Index(b)) = time(all_[a]->last, all_[b]->first);
      if (problem.from) begin_[Eigen::Index(a)] = time(*problem.from, all_[a]->first);
    }
  }

  int paths() const { return int(problem_.variants.size()); }

  /// The least duration of all transfers in an order; `chosen` receives the variants.
  double costOf(const std::vector<int>& order, std::vector<int>* chosen = nullptr) const {
    std::vector<double> cost, next;
    std::vector<std::vector<int>> before(order.size());
    for (int b = first_[std::size_t(order[0])]; b < first_[std::size_t(order[0]) + 1]; ++b) cost.push_back(begin_[b]);
    for (std::size_t k = 1; k < order.size(); ++k) {
      next.clear();
      const int a0 = first_[std::size_t(order[k - 1])];
      for (int b = first_[std::size_t(order[k])]; b < first_[std::size_t(order[k]) + 1]; ++b) {
        double best = std::numeric_limits<double>::infinity();
        int from = 0;
        for (int a = 0; a < int(cost.size()); ++a)
          if (cost[std::size_t(a)] + cost_(a0 + a, b) < best) best = cost[std::size_t(a)] + cost_(a0 + a, b), from = a;
        next.push_back(best);
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
        const double least = cost_
                                 .block(first_[std::size_t(order.back())], first_[std::size_t(k)],
                                        first_[std::size_t(order.back()) + 1] - first_[std::size_t(order.back())],
                                        first_[std::size_t(k) + 1] - first_[std::size_t(k)])
                                 .minCoeff();
        if (least < best) best = least, next = k;
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
  double time(const VectorXd& from, const VectorXd& to) const {
    return ((to - from).array() / problem_.velocity.array()).abs().maxCoeff();
  }

  const OrderProblem& problem_;
  std::vector<const PathVariant*> all_;
  std::vector<int> first_;  ///< per path: index of its first variant
  MatrixXd cost_;
  VectorXd begin_;
};

}  // namespace

std::vector<OrderedPath> orderPaths(const OrderProblem& problem) {
  const OrderSearch search(problem);
  std::vector<int> order;
  for (int k = 0; k < search.paths(); ++k) order.push_back(k);
  if (problem.free_order && search.paths() > 1) {
    double least = std::numeric_limits<double>::infinity();
    const int starts = std::min(search.paths(), 4);
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
    result.push_back({order[k], variant.solution, variant.reversed});
  }
  return result;
}

}  // namespace kinegraph
