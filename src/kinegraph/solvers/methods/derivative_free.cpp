#include "kinegraph/solvers/methods/derivative_free.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/problems/cost_function.h"

namespace kinegraph::inline solvers_internal {

namespace {

/// Returns an initial spread that fits the bounds.
double firstSpread(const CostFunction& cost, int n) {
  double spread = .5;
  for (int i = 0; i < n; ++i) {
    if (cost.width(i) > 0.) spread = std::min(spread, .25 * cost.width(i));
  }
  return spread;
}

}  // namespace

SolverResult solveNelderMead(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                             const EvaluationCallback& callback) {
  CostFunction cost(nlp, x0, options, callback, "NelderMead", false);
  const int n = int(x0.size());
  if (n == 0) return cost.result(SolverStatus::converged, "the problem has no variables");
  const double expand = 1. + 2. / n, contract = .75 - .5 / n, shrink = n == 1 ? .5 : 1. - 1. / n;
  std::vector<std::pair<double, VectorXd>> simplex;
  const auto byValue = [](const auto& a, const auto& b) { return a.first < b.first; };
  const auto build = [&](double spread) {
    const VectorXd center = cost.best();
    simplex.assign(1, {cost.bestValue(), center});
    for (int i = 0; i < n && !cost.ended(); ++i) {
      VectorXd corner = center;
      corner[i] += spread;
      corner = cost.clip(corner);
      if (corner[i] - center[i] < .5 * spread)
        corner[i] = std::max(center[i] - spread, cost.clip(center - VectorXd::Constant(n, spread))[i]);
      simplex.emplace_back(cost.value(corner), corner);
    }
  };
  double spread = firstSpread(cost, n), value_at_restart = cost.startValue();
  build(spread);
  int restarts = 0;
  while (!cost.ended()) {
    std::stable_sort(simplex.begin(), simplex.end(), byValue);
    double size = 0.;
    for (const auto& corner : simplex)
      size = std::max(size, (corner.second - simplex[0].second).lpNorm<Eigen::Infinity>());
    const double range = simplex.back().first - simplex[0].first;
    if (size <= .1 * options.stopTolerance ||
        (size <= 10. * options.stopTolerance && range <= 1e-14 * std::max(1., std::abs(simplex[0].first)))) {
      // a simplex may collapse away from a minimum: a new one must not improve the value
      const bool improved = value_at_restart - cost.bestValue() > 1e-9 * std::max(1., std::abs(value_at_restart));
      if (restarts > 0 && !improved)
        return cost.result(SolverStatus::converged, cat("a simplex of size ", size, " after a restart"));
      ++restarts;
      value_at_restart = cost.bestValue();
      spread = std::max(.1 * spread, 100. * options.stopTolerance);
      build(spread);
      continue;
    }
    VectorXd center = VectorXd::Zero(n);
    for (int i = 0; i < n; ++i) center += simplex[i].second / n;
    auto& worst = simplex.back();
    const auto trial = [&](double factor) {
      const VectorXd x = cost.clip(center + factor * (worst.second - center));
      return std::pair<double, VectorXd>(cost.value(x), x);
    };
    auto reflected = trial(-1.);
    if (cost.ended()) break;
    if (reflected.first < simplex[0].first) {
      auto expanded = trial(-expand);
      worst = expanded.first < reflected.first ? expanded : reflected;
    } else if (reflected.first < simplex[n - 1].first) {
      worst = reflected;
    } else {
      const bool outside = reflected.first < worst.first;
      auto contracted = trial(outside ? -contract : contract);
      if (contracted.first < std::min(worst.first, outside ? reflected.first : worst.first)) {
        worst = contracted;
      } else {
        for (int i = 1; i <= n && !cost.ended(); ++i) {
          simplex[i].second = simplex[0].second + shrink * (simplex[i].second - simplex[0].second);
          simplex[i].first = cost.value(simplex[i].second);
        }
      }
    }
  }
  return cost.result(SolverStatus::stalled, "");
}

SolverResult solveCma(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback) {
  CostFunction cost(nlp, x0, options, callback, "CMA", false);
  const int n = int(x0.size());
  if (n == 0) return cost.result(SolverStatus::converged, "the problem has no variables");
  const int population = 4 + int(3. * std::log(n)), parents = population / 2;
  VectorXd weights(parents);
  for (int i = 0; i < parents; ++i) weights[i] = std::log(.5 * (population + 1)) - std::log(i + 1.);
  weights /= weights.sum();
  const double mu = 1. / weights.squaredNorm();
  const double c_sigma = (mu + 2.) / (n + mu + 5.),
               damping = 1. + 2. * std::max(0., std::sqrt((mu - 1.) / (n + 1.)) - 1.) + c_sigma;
  const double c_c = (4. + mu / n) / (n + 4. + 2. * mu / n), c_1 = 2. / ((n + 1.3) * (n + 1.3) + mu);
  const double c_mu = std::min(1. - c_1, 2. * (mu - 2. + 1. / mu) / ((n + 2.) * (n + 2.) + mu));
  const double expected = std::sqrt(double(n)) * (1. - 1. / (4. * n) + 1. / (21. * n * n));

  Rng rng(0);
  VectorXd mean = cost.start(), path_sigma = VectorXd::Zero(n), path_c = VectorXd::Zero(n), scales = VectorXd::Ones(n);
  MatrixXd C = MatrixXd::Identity(n, n), axes = C;
  double sigma = firstSpread(cost, n);
  std::vector<VectorXd> steps(population);
  std::vector<double> values(population), outside(population);
  std::vector<int> order(population);
  for (int generation = 1; !cost.ended(); ++generation) {
    for (int k = 0; k < population && !cost.ended(); ++k) {
      VectorXd z(n);
      for (double& value : z) value = rng.normal();
      steps[k] = axes * scales.cwiseProduct(z);
      const VectorXd x = mean + sigma * steps[k], inside = cost.clip(x);
      values[k] = cost.value(inside);
      outside[k] = (x - inside).squaredNorm();
    }
    if (cost.ended()) break;
    // a point outside counts as its projection to the bounds, plus a penalty that grows with the distance
    double low = values[0], high = values[0];
    for (double value : values) low = std::min(low, value);
    for (double value : values) high = std::isfinite(value) ? std::max(high, value) : high;
    const double weight = (high - low + 1e-12 * std::abs(low)) / (sigma * sigma * C.diagonal().mean());
    for (int k = 0; k < population; ++k) values[k] += weight * outside[k];
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return values[a] < values[b]; });
    VectorXd step = VectorXd::Zero(n);
    for (int i = 0; i < parents; ++i) step += weights[i] * steps[order[i]];
    mean += sigma * step;
    const VectorXd whitened = axes * (axes.transpose() * step).cwiseQuotient(scales);
    path_sigma = (1. - c_sigma) * path_sigma + std::sqrt(c_sigma * (2. - c_sigma) * mu) * whitened;
    const double length = path_sigma.norm() / std::sqrt(1. - std::pow(1. - c_sigma, 2. * generation));
    const bool steady = length < (1.4 + 2. / (n + 1.)) * expected;
    path_c = (1. - c_c) * path_c + (steady ? std::sqrt(c_c * (2. - c_c) * mu) : 0.) * step;
    C *= 1. - c_1 - c_mu + (steady ? 0. : c_1 * c_c * (2. - c_c));
    C += c_1 * path_c * path_c.transpose();
    for (int i = 0; i < parents; ++i) C += c_mu * weights[i] * steps[order[i]] * steps[order[i]].transpose();
    sigma *= std::exp(std::min(1., c_sigma / damping * (path_sigma.norm() / expected - 1.)));
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(C);
    axes = eigen.eigenvectors();
    scales = eigen.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
    const double size = sigma * scales.maxCoeff();
    if (size <= .1 * options.stopTolerance)
      return cost.result(SolverStatus::converged, cat("the population has shrunk to the size ", size));
    if (!std::isfinite(size) || scales.maxCoeff() > 1e7 * scales.minCoeff()) {
      return cost.result(SolverStatus::stalled, "the covariance of the population has become singular");
    }
  }
  return cost.result(SolverStatus::stalled, "");
}

}  // namespace kinegraph::inline solvers_internal
