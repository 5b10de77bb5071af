#include "kinegraph/solvers/sequential_quadratic.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/solvers/quadratic_program.h"
#include "kinegraph/solvers/quasi_newton.h"

namespace kinegraph {

namespace {

constexpr int kLargestDimension = 200;  ///< of problems whose curvature is learnt as a full matrix

/// Equalities first.
std::vector<int> constraintsOf(const Nlp& nlp, int& equalities) {
  std::vector<int> rows;
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    if (nlp.types()[row] == ObjectiveType::eq) rows.push_back(row);
  }
  equalities = int(rows.size());
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    if (nlp.types()[row] == ObjectiveType::ineq || nlp.types()[row] == ObjectiveType::ineqB) rows.push_back(row);
  }
  return rows;
}

class SequentialQuadratic {
 public:
  SequentialQuadratic(Nlp& nlp, const SolverOptions& options, const EvaluationHook& hook)
      : nlp_(nlp), options_(options), hook_(hook), constraints_(constraintsOf(nlp, equalities_)), J_(nlp.makeJacobian()), trial_J_(J_),
        tolerance_(options.constraintTolerance()) {
    for (VectorXd* v : {&phi_, &trial_phi_}) v->setZero(Eigen::Index(nlp.types().size()));
    for (VectorXd* v : {&lambda_, &weights_, &row_scale_}) v->setZero(Eigen::Index(constraints_.size()));
    lower_ = nlp.lower();
    upper_ = nlp.upper();
    if (!options.boundedNewton) {
      lower_.setConstant(-std::numeric_limits<double>::infinity());
      upper_ = -lower_;
    }
  }

  SolverResult run(const VectorXd& x0) {
    const auto start = std::chrono::steady_clock::now();
    x_ = x0.cwiseMax(lower_).cwiseMin(upper_);
    curvature_.reset(nlp_.dimension());
    evaluate(x_, phi_, J_);
    if (const std::string what = describeNotFinite(nlp_, phi_, &J_); !what.empty()) throw ValueError(cat("at the start, ", what));
    remember();
    iterate();
    if (status_ != SolverStatus::converged) {
      x_ = best_x_;
      phi_ = best_phi_;
    }
    return result(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }

 private:
  /// A step that solves a quadratic program, and what it promises.
  struct Step {
    VectorXd d, lambda, linear;  ///< linear: constraints after the step, to first order
    double relaxed = 0.;         ///< part of the violation that the linearized constraints had to keep; 0 if they are consistent
    bool found = false;
  };

  void iterate();
  void linearize(double shift);
  Step solveQuadratic(const VectorXd& c);
  bool lineSearch(const Step& step);
  VectorXd constraintsAt(const VectorXd& phi) const {
    VectorXd c(constraints_.size());
    for (std::size_t j = 0; j < constraints_.size(); ++j) c[Eigen::Index(j)] = phi[constraints_[j]];
    return c;
  }

  /// Evaluates there; the merit function, infinite where numbers are not finite.
  double tryStep(const VectorXd& d) {
    trial_ = (x_ + d).cwiseMax(lower_).cwiseMin(upper_);
    evaluate(trial_, trial_phi_, trial_J_);
    return describeNotFinite(nlp_, trial_phi_, &trial_J_).empty() ? merit(trial_phi_) : std::numeric_limits<double>::infinity();
  }

  void learnCurvature(const VectorXd& before, const Jacobian& J_before);

  void stop(SolverStatus status, std::string message) {
    status_ = status;
    message_ = std::move(message);
    stopped_ = true;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian& J) {
    nlp_.evaluate(x, phi, &J);
    ++evals_;
    if (hook_ && !hook_(x, phi)) stop(SolverStatus::cancelled, "cancelled by the caller");
  }

  double cost(const VectorXd& phi) const {
    const ErrorSums sums = sumErrors(nlp_.types(), phi);
    return sums.f + sums.sos;
  }

  double broken(int j, double c) const { return (j < equalities_) ? std::abs(c) : std::max(0., c); }

  double merit(const VectorXd& phi) const {
    double sum = cost(phi);
    for (int j = 0; j < weights_.size(); ++j) sum += weights_[j] * broken(j, phi[constraints_[j]]);
    return sum;
  }

  void remember() {
    const double v = largestViolation(nlp_.types(), phi_), c = cost(phi_);
    const bool better = best_x_.size() == 0 || (v <= tolerance_ && best_violation_ <= tolerance_ ? c < best_cost_ : v < best_violation_);
    if (!better) return;
    best_x_ = x_;
    best_phi_ = phi_;
    best_violation_ = v;
    best_cost_ = c;
  }

  /// Gradient of the costs; without that of the squares if `only_f`.
  void costGradient(const VectorXd& phi, const Jacobian& J, bool only_f, VectorXd& gradient) const {
    gradient.setZero(nlp_.dimension());
    for (int row = 0; row < phi.size(); ++row) {
      const ObjectiveType type = nlp_.types()[row];
      if (type == ObjectiveType::f) J.addRowTo(row, 1., gradient);
      if (only_f) continue;
      if (type == ObjectiveType::sos || (type == ObjectiveType::ineqP && phi[row] > 0.)) J.addRowTo(row, 2. * phi[row], gradient);
    }
  }

  void addConstraintGradient(const Jacobian& J, const VectorXd& lambda, VectorXd& gradient) const {
    for (int j = 0; j < lambda.size(); ++j) J.addRowTo(constraints_[j], lambda[j], gradient);
  }

  SolverResult result(double seconds);

  Nlp& nlp_;
  const SolverOptions& options_;
  const EvaluationHook& hook_;
  QuasiNewton curvature_;
  int equalities_ = 0;
  std::vector<int> constraints_;  ///< rows, equalities first
  Jacobian J_, trial_J_;
  MatrixXd H_, A_;       ///< of the quadratic program; A with rows of length 1
  VectorXd row_scale_;   ///< one over their length in J
  VectorXd x_, trial_, phi_, trial_phi_, lambda_, weights_, lower_, upper_, gradient_, old_gradient_, best_x_, best_phi_;
  double best_violation_ = 0., best_cost_ = 0., tolerance_;
  int evals_ = 0;
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string message_;
};

/// Gradient and Hessian of the costs, and the constraints' rows.
void SequentialQuadratic::linearize(double shift) {
  const int n = nlp_.dimension();
  costGradient(phi_, J_, false, gradient_);
  H_ = curvature_.matrix();
  H_.diagonal().array() += shift;
  VectorXd row_of_J = VectorXd::Zero(n);
  for (int row = 0; row < phi_.size(); ++row) {
    const ObjectiveType type = nlp_.types()[row];
    if (type != ObjectiveType::sos && !(type == ObjectiveType::ineqP && phi_[row] > 0.)) continue;
    row_of_J.setZero();
    J_.addRowTo(row, 1., row_of_J);
    H_.noalias() += 2. * row_of_J * row_of_J.transpose();
  }
  A_.setZero(Eigen::Index(constraints_.size()), n);
  for (int j = 0; j < A_.rows(); ++j) {
    row_of_J.setZero();
    J_.addRowTo(constraints_[j], 1., row_of_J);
    row_scale_[j] = 1. / std::max(row_of_J.norm(), 1e-8);
    A_.row(j) = row_scale_[j] * row_of_J.transpose();
  }
}

/// min g^T d + 1/2 d^T H d  with c + J d = 0 or <= 0, in the bounds. Where these contradict each other, they are relaxed:
/// a part of their violation, as small as possible, remains.
SequentialQuadratic::Step SequentialQuadratic::solveQuadratic(const VectorXd& c) {
  const int n = nlp_.dimension(), m = int(constraints_.size());
  std::vector<int> bounded;
  for (int i = 0; i < n; ++i) {
    if (std::isfinite(lower_[i])) bounded.push_back(-i - 1);
    if (std::isfinite(upper_[i])) bounded.push_back(i + 1);
  }
  QuadraticProgram program;
  program.H = H_;
  program.g = gradient_;
  program.equalities = equalities_;
  program.A = MatrixXd::Zero(m + Eigen::Index(bounded.size()), n);
  program.A.topRows(m) = A_;
  program.b.resize(program.A.rows());
  program.b.head(m) = c.cwiseProduct(row_scale_);
  for (std::size_t k = 0; k < bounded.size(); ++k) {
    const int i = std::abs(bounded[k]) - 1, sign = bounded[k] > 0 ? 1 : -1;
    program.A(m + Eigen::Index(k), i) = sign;
    program.b[m + Eigen::Index(k)] = sign > 0 ? x_[i] - upper_[i] : lower_[i] - x_[i];
  }
  QuadraticSolution solution = solve(program);
  Step step;
  if (solution.status != QuadraticStatus::solved && m > 0) {
    const Eigen::Index rows = program.A.rows();
    program.H.conservativeResize(n + 1, n + 1);
    program.H.row(n).setZero();
    program.H.col(n).setZero();
    program.g.conservativeResize(n + 1);
    program.g[n] = 0.;
    program.A.conservativeResize(rows + 2, n + 1);
    program.A.bottomRows(2).setZero();
    program.A.col(n).setZero();
    program.b.conservativeResize(rows + 2);
    for (int j = 0; j < m; ++j) {
      if (j < equalities_ || c[j] > 0.) program.A(j, n) = -program.b[j];
    }
    program.A(rows, n) = -1.;  // 0 <= the last variable <= 1
    program.b[rows] = 0.;
    program.A(rows + 1, n) = 1.;
    program.b[rows + 1] = -1.;
    double weight = 1e3 * std::max(1., std::abs(cost(phi_)));
    for (int attempt = 0; attempt < 4; ++attempt, weight *= 100.) {
      program.H(n, n) = weight;
      QuadraticSolution relaxed = solve(program);
      if (relaxed.status != QuadraticStatus::solved) continue;
      solution = relaxed;
      step.relaxed = std::clamp(relaxed.x[n], 1e-16, 1.);
      if (step.relaxed < .9) break;
    }
  }
  step.found = solution.status == QuadraticStatus::solved;
  step.d = solution.x.head(n);
  step.lambda = solution.multipliers.head(m).cwiseProduct(row_scale_);
  step.linear = c + (A_ * step.d).cwiseQuotient(row_scale_);
  return step;
}

/// Moves along the step, or a correction of it, until the merit function has decreased enough. False if it does not.
bool SequentialQuadratic::lineSearch(const Step& step) {
  double slope = gradient_.dot(step.d), reduction = 0.;
  for (int j = 0; j < weights_.size(); ++j) {
    const double reduces = broken(j, phi_[constraints_[j]]) - broken(j, step.linear[j]);
    if (step.relaxed == 0.) weights_[j] = std::max(std::abs(step.lambda[j]), .5 * (weights_[j] + std::abs(step.lambda[j])));
    reduction += reduces * row_scale_[j];
    slope -= weights_[j] * reduces;
  }
  const double curvature = step.d.dot(H_ * step.d);
  if (slope > -.5 * curvature && reduction > 0.) {  // feasibility must weigh more for this to be a descent
    const double more = (slope + curvature) / reduction;
    for (int j = 0; j < weights_.size(); ++j) weights_[j] += more * row_scale_[j];
    slope = -curvature;
  }
  const double before = merit(phi_), noise = 1e-13 * (1. + std::abs(before));
  double alpha = 1.;
  for (int attempt = 0; attempt < 12; ++attempt) {
    if (evals_ >= options_.stopEvals) break;
    const double after = tryStep(alpha * step.d);
    if (stopped_) return false;
    if (after <= before + 1e-4 * alpha * slope + noise) return true;
    const bool finite = std::isfinite(after);
    if (attempt == 0 && finite && !constraints_.empty()) {
      const Step second = solveQuadratic(constraintsAt(trial_phi_) - (A_ * step.d).cwiseQuotient(row_scale_));
      if (second.found && (second.d - step.d).norm() < step.d.norm()) {
        const double corrected = tryStep(second.d);
        if (stopped_) return false;
        if (corrected <= before + 1e-4 * slope + noise) return true;
      }
    }
    const double parabola = finite ? -.5 * alpha * alpha * slope / (after - before - alpha * slope) : 0.;
    alpha = std::clamp(parabola, .1 * alpha, .5 * alpha);
  }
  return false;
}

void SequentialQuadratic::learnCurvature(const VectorXd& before, const Jacobian& J_before) {
  costGradient(phi_, J_before, true, old_gradient_);
  addConstraintGradient(J_before, lambda_, old_gradient_);
  costGradient(phi_, J_, true, gradient_);
  addConstraintGradient(J_, lambda_, gradient_);
  curvature_.update(x_ - before, gradient_ - old_gradient_);
}

void SequentialQuadratic::iterate() {
  int resets = 0;
  for (int count = 0; !stopped_; ++count) {
    if (evals_ >= options_.stopEvals) return stop(SolverStatus::limit, cat("limit of ", options_.stopEvals, " evaluations"));
    if (count >= options_.stopInners) return stop(SolverStatus::limit, cat("limit of ", options_.stopInners, " steps"));
    const double room = std::max(1., x_.lpNorm<Eigen::Infinity>());
    costGradient(phi_, J_, false, gradient_);
    linearize(curvature_.empty() ? std::max(1e-8, gradient_.lpNorm<Eigen::Infinity>() / room) : 0.);
    const Step step = solveQuadratic(constraintsAt(phi_));
    const double violation = largestViolation(nlp_.types(), phi_), size = step.d.lpNorm<Eigen::Infinity>();
    double promised = std::abs(gradient_.dot(step.d));
    for (int j = 0; j < lambda_.size(); ++j) promised += std::abs(step.lambda[j] * phi_[constraints_[j]]);
    const double scale = std::max(1., std::abs(cost(phi_)));
    if (options_.verbose > 2) {
      std::printf("    step %3d  evals %3d  cost %.10g  |d| %.3g  promised %.3g  violation %.3g%s\n", count, evals_, cost(phi_), size, promised,
                  violation, !step.found ? "  (no step)" : step.relaxed > 0. ? "  (relaxed)" : "");
    }
    if (violation <= tolerance_ && step.found && ((size <= options_.stopTolerance * room && promised <= std::max(std::pow(options_.stopTolerance, 2), 1e-12) * scale) ||
                                                        promised <= 1e-14 * scale)) {
      lambda_ = step.lambda;
      return stop(SolverStatus::converged, cat("step ", size, ", its predicted decrease ", promised, ", and violation ", violation,
                                               " are within tolerances"));
    }
    if (!step.found || size <= 1e-15 * room || !lineSearch(step)) {
      if (stopped_) return;
      if (curvature_.empty() || ++resets > 5) return stop(SolverStatus::stalled, "no step decreases the objective as predicted");
      curvature_.reset(nlp_.dimension());
      weights_.setZero();
      continue;
    }
    if (step.relaxed < .1) lambda_ = step.lambda;
    x_.swap(trial_);
    phi_.swap(trial_phi_);
    std::swap(J_, trial_J_);
    learnCurvature(trial_, trial_J_);
    remember();
  }
}

SolverResult SequentialQuadratic::result(double seconds) {
  SolverResult out;
  out.x = x_;
  out.dual = VectorXd::Zero(phi_.size());
  for (std::size_t j = 0; j < constraints_.size(); ++j) out.dual[constraints_[j]] = lambda_[j];
  out.evals = evals_;
  out.time = seconds;
  out.setSums(nlp_.types(), phi_, tolerance_);
  out.status = status_;
  out.message = message_;
  nlp_.evaluate(x_, phi_, nullptr);  // leaves the problem at the point that is returned
  return out;
}

}  // namespace

bool needsLearntCurvature(Nlp& nlp, const VectorXd& x) {
  const auto& types = nlp.types();
  if (std::find(types.begin(), types.end(), ObjectiveType::f) == types.end()) return false;
  if (nlp.dimension() == 0 || nlp.dimension() > kLargestDimension) return false;
  MatrixXd hessian = MatrixXd::Zero(nlp.dimension(), nlp.dimension());
  return !nlp.addCostHessian(x, hessian);
}

SolverResult solveSequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook) {
  options.validate();
  requireStart(nlp, x0);
  return SequentialQuadratic(nlp, options, hook).run(x0);
}

}  // namespace kinegraph
