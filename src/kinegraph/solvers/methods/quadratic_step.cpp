#include "kinegraph/solvers/methods/quadratic_step.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/algebra/quadratic_program.h"

namespace kinegraph::inline solvers_internal {

namespace {

constexpr int kMaxVariables = 200, kMaxConstraints = 1000;
constexpr double kRelative = 1e-10;

/// The quadratic model of the problem at a point, as a function of the step d.
struct Model {
  MatrixXd H, A;
  VectorXd g, b;
  std::vector<int> bound;  ///< per row of A after the constraints: 1 + i for an upper bound of variable i,
                           ///< -1 - i for a lower one
};

std::optional<Model> modelAt(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi,
                             const Jacobian& J) {
  const int n = int(x.size()), constraints = int(function.constraints().size());
  Model model{MatrixXd::Zero(n, n), {}, VectorXd::Zero(n), {}, {}};
  VectorXd row = VectorXd::Zero(n);
  const auto readRow = [&](int index) {
    row.setZero();
    J.addRowTo(index, 1., row);
  };
  bool has_f = false;
  for (int index : function.costs()) {
    const ObjectiveType type = function.types()[std::size_t(index)];
    if (type == ObjectiveType::ineqP) return std::nullopt;
    readRow(index);
    if (type == ObjectiveType::f) {
      model.g += row;
      has_f = true;
      continue;
    }
    model.g += 2. * phi[index] * row;
    model.H.selfadjointView<Eigen::Lower>().rankUpdate(row, 2.);
  }
  model.H.triangularView<Eigen::StrictlyUpper>() = model.H.transpose();
  if (has_f && !function.nlp().addCostHessian(x, model.H)) return std::nullopt;
  for (int i = 0; i < n; ++i) {
    if (std::isfinite(function.lower()[i])) model.bound.push_back(-1 - i);
    if (std::isfinite(function.upper()[i])) model.bound.push_back(1 + i);
  }
  const int rows = constraints + int(model.bound.size());
  if (rows > kMaxConstraints) return std::nullopt;
  model.A = MatrixXd::Zero(rows, n);
  model.b = VectorXd::Zero(rows);
  for (int j = 0; j < constraints; ++j) {
    readRow(function.constraints()[std::size_t(j)]);
    model.A.row(j) = row;
    model.b[j] = phi[function.constraints()[std::size_t(j)]];
  }
  for (std::size_t k = 0; k < model.bound.size(); ++k) {
    const int i = std::abs(model.bound[k]) - 1, j = constraints + int(k);
    const bool upper = model.bound[k] > 0;
    model.A(j, i) = upper ? 1. : -1.;
    model.b[j] = upper ? x[i] - function.upper()[i] : function.lower()[i] - x[i];
  }
  return model;
}

/// Refines d and the multipliers of the active constraints by the solution of their linear system.
void polish(const Model& model, int equalities, VectorXd& d, VectorXd& multipliers) {
  std::vector<int> active;
  for (int j = 0; j < int(model.b.size()); ++j) {
    if (j < equalities || multipliers[j] > 0.) active.push_back(j);
  }
  const int n = int(d.size()), m = int(active.size());
  MatrixXd K = MatrixXd::Zero(n + m, n + m);
  K.topLeftCorner(n, n) = model.H;
  for (int k = 0; k < m; ++k) {
    K.row(n + k).head(n) = model.A.row(active[std::size_t(k)]);
    K.col(n + k).head(n) = model.A.row(active[std::size_t(k)]).transpose();
  }
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> factor(K);
  for (int pass = 0; pass < 2; ++pass) {
    VectorXd rest(n + m);
    rest.head(n) = -(model.g + model.H * d + model.A.transpose() * multipliers);
    for (int k = 0; k < m; ++k)
      rest[n + k] = -(model.A.row(active[std::size_t(k)]).dot(d) + model.b[active[std::size_t(k)]]);
    const VectorXd change = factor.solve(rest);
    if (!change.allFinite()) return;
    d += change.head(n);
    for (int k = 0; k < m; ++k) multipliers[active[std::size_t(k)]] += change[n + k];
  }
}

}  // namespace

std::optional<QuadraticStep> quadraticStep(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi,
                                           const Jacobian& J) {
  if (x.size() > kMaxVariables || !function.nlp().mayBeQuadratic()) return std::nullopt;
  const std::optional<Model> model = modelAt(function, x, phi, J);
  if (!model || !model->H.allFinite() || !model->A.allFinite()) return std::nullopt;
  // Proximal iterations: each regularizes around the step before, so that a singular H is no problem in the limit.
  const double largest = model->H.diagonal().cwiseAbs().maxCoeff(), regularization = largest > 0. ? 1e-7 * largest : 1.;
  QuadraticProgram program{model->H, model->g, model->A, model->b, function.equalities()};
  program.H.diagonal().array() += regularization;
  VectorXd d = VectorXd::Zero(x.size());
  QuadraticSolution solution;
  DualActiveSet workspace;
  for (int pass = 0; pass < 20; ++pass) {
    program.g = model->g - regularization * d;
    solution = solve(program, workspace);
    if (solution.status != QuadraticStatus::solved || !solution.x.allFinite()) return std::nullopt;
    const double moved = (solution.x - d).lpNorm<Eigen::Infinity>();
    d = solution.x;
    if (moved <= 1e-9 * (1. + d.lpNorm<Eigen::Infinity>())) break;
  }
  polish(*model, function.equalities(), d, solution.multipliers);
  return QuadraticStep{function.clip(x + d), solution.multipliers.head(Eigen::Index(function.constraints().size()))};
}

bool isSolution(const ConstrainedFunction& function, const VectorXd& x, const VectorXd& phi, const Jacobian& J,
                const VectorXd& multipliers) {
  VectorXd gradient;
  function.costGradient(phi, J, gradient);
  VectorXd magnitude = VectorXd::Ones(x.size());  // sum of the magnitudes of the terms that cancel
  const auto addMagnitude = [&](int row, double factor) {
    for (const Jacobian::Segment& segment : J.row_segments(row)) {
      for (int i = 0; i < segment.width; ++i)
        magnitude[segment.column + i] += std::abs(factor * J.values[std::size_t(segment.offset + i)]);
    }
  };
  for (int row : function.costs())
    addMagnitude(row, function.types()[std::size_t(row)] == ObjectiveType::f ? 1. : 2. * phi[row]);
  for (int j = 0; j < int(multipliers.size()); ++j) {
    const int row = function.constraints()[std::size_t(j)];
    const double c = phi[row], lambda = multipliers[j];
    addMagnitude(row, lambda);
    J.addRowTo(row, lambda, gradient);
    double size = 1.;
    for (const Jacobian::Segment& segment : J.row_segments(row)) {
      for (int i = 0; i < segment.width; ++i)
        size += std::abs(J.values[std::size_t(segment.offset + i)] * x[segment.column + i]);
    }
    const double small = kRelative * size;
    if (j < function.equalities() ? std::abs(c) > small : c > small) return false;
    if (j >= function.equalities() && (lambda < -kRelative * (1. + std::abs(lambda)) || (lambda > 0. && c < -small)))
      return false;
  }
  for (int i = 0; i < int(x.size()); ++i) {
    const double down = std::min(std::max(x[i] - gradient[i], function.lower()[i]), function.upper()[i]) - x[i];
    if (!(std::abs(down) <= kRelative * magnitude[i])) return false;
  }
  return true;
}

}  // namespace kinegraph::inline solvers_internal
