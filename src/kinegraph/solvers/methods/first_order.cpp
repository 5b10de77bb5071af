#include "kinegraph/solvers/methods/first_order.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/problems/cost_function.h"

namespace kinegraph::inline solvers_internal {

namespace {

std::string smallStep(double size) { return cat("step ", size, " is within its tolerance"); }

/// The last changes of x and of the gradient, the newest last.
class Memory {
 public:
  void add(const VectorXd& s, const VectorXd& y) {
    if (s.dot(y) <= 1e-10 * y.squaredNorm()) return;
    pairs_.push_back({s, y});
    if (pairs_.size() > 10) pairs_.pop_front();
  }
  void clear() { pairs_.clear(); }
  bool empty() const { return pairs_.empty(); }

  /// Returns -H g by the two-loop recursion.
  VectorXd direction(const VectorXd& g) const {
    VectorXd q = g;
    std::vector<double> alpha(pairs_.size());
    for (int i = int(pairs_.size()) - 1; i >= 0; --i) {
      const auto& [s, y] = pairs_[i];
      alpha[i] = s.dot(q) / s.dot(y);
      q -= alpha[i] * y;
    }
    if (!pairs_.empty()) q *= pairs_.back().first.dot(pairs_.back().second) / pairs_.back().second.squaredNorm();
    for (std::size_t i = 0; i < pairs_.size(); ++i) {
      const auto& [s, y] = pairs_[i];
      q += (alpha[i] - y.dot(q) / s.dot(y)) * s;
    }
    return -q;
  }

 private:
  std::deque<std::pair<VectorXd, VectorXd>> pairs_;
};

}  // namespace

SolverResult solveGradientDescent(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                  const EvaluationCallback& callback) {
  CostFunction cost(nlp, x0, options, callback, "gradientDescent", true);
  VectorXd x = cost.start(), g = cost.startGradient(), next_g;
  double value = cost.startValue(), length = options.stepMax;
  while (!cost.ended()) {
    const VectorXd free = cost.freeGradient(x, g);
    if (free.isZero(0.)) return cost.result(SolverStatus::converged, "the gradient is zero");
    const VectorXd next = cost.clip(x - length / free.lpNorm<Eigen::Infinity>() * free);
    const double size = (next - x).lpNorm<Eigen::Infinity>(), after = cost.value(next, next_g);
    // in a valley, steps are short far from the minimum, too, so that only very short ones count as converged
    const bool tiny = size <= .1 * options.stopTolerance;
    if (after <= value + options.wolfe * g.dot(next - x)) {
      x = next;
      g = next_g;
      value = after;
      length = std::min(options.stepMax, options.stepInc * length);
    } else {
      length *= options.stepDec;
    }
    if (tiny) return cost.result(SolverStatus::converged, smallStep(size));
  }
  return cost.result(SolverStatus::stalled, "");
}

SolverResult solveRprop(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                        const EvaluationCallback& callback) {
  CostFunction cost(nlp, x0, options, callback, "rprop", true);
  VectorXd x = cost.start(), g = cost.startGradient(), last = VectorXd::Zero(x.size());
  VectorXd step = VectorXd::Constant(x.size(), .1 * options.stepMax);
  while (!cost.ended()) {
    g = cost.freeGradient(x, g);
    if (g.isZero(0.)) return cost.result(SolverStatus::converged, "the gradient is zero");
    double largest = 0.;
    VectorXd next = x;
    for (int i = 0; i < x.size(); ++i) {
      if (g[i] == 0.) continue;  // at an active bound
      const double agreement = g[i] * last[i];
      if (agreement > 0.) step[i] = std::min(1.2 * step[i], options.stepMax);
      if (agreement < 0.) step[i] *= .5;
      largest = std::max(largest, step[i]);
      if (agreement < 0.) {
        g[i] = 0.;  // skips one step
      } else {
        next[i] -= g[i] > 0. ? step[i] : -step[i];
      }
    }
    if (largest <= options.stopTolerance) return cost.result(SolverStatus::converged, smallStep(largest));
    last = g;
    x = cost.clip(next);
    if (!std::isfinite(cost.value(x, g))) {  // returns to the best point, with smaller steps
      x = cost.best();
      step *= .5;
      if (cost.ended() || !std::isfinite(cost.value(x, g))) break;
      last.setZero();
    }
  }
  return cost.result(SolverStatus::stalled, "");
}

SolverResult solveLbfgs(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                        const EvaluationCallback& callback) {
  CostFunction cost(nlp, x0, options, callback, "LBFGS", true);
  VectorXd x = cost.start(), g = cost.startGradient(), next_g;
  double value = cost.startValue();
  Memory memory;
  while (!cost.ended()) {
    const VectorXd free = cost.freeGradient(x, g);
    if (free.isZero(0.)) return cost.result(SolverStatus::converged, "the gradient is zero");
    VectorXd d = memory.direction(free);
    for (int i = 0; i < x.size(); ++i) {
      if (free[i] == 0.) d[i] = 0.;
    }
    if (!(d.dot(free) < -1e-10 * d.norm() * free.norm())) {
      memory.clear();
      d = -free;
    }
    const double largest = d.lpNorm<Eigen::Infinity>();
    if (memory.empty()) d *= std::min(1., .1 * options.stepMax / largest);
    if (largest > options.stepMax && !memory.empty()) d *= options.stepMax / largest;
    double alpha = 1., after = 0., size = 0.;
    VectorXd next;
    bool accepted = false;
    for (; !accepted && !cost.ended(); alpha *= .5) {
      next = cost.clip(x + alpha * d);
      size = (next - x).lpNorm<Eigen::Infinity>();
      if (size < 1e-3 * options.stopTolerance) break;
      after = cost.value(next, next_g);
      accepted = after <= value + 1e-4 * g.dot(next - x);
    }
    if (!accepted) {
      if (cost.ended()) break;
      if (memory.empty()) return cost.result(SolverStatus::converged, smallStep(size));
      memory.clear();  // tries the gradient once more
      continue;
    }
    const bool tiny = size <= .1 * options.stopTolerance && !memory.empty();
    memory.add(next - x, next_g - g);
    x = next;
    g = next_g;
    value = after;
    if (tiny) return cost.result(SolverStatus::converged, smallStep(size));
  }
  return cost.result(SolverStatus::stalled, "");
}

}  // namespace kinegraph::inline solvers_internal
