#include "kinegraph/solvers/methods/sequential_quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/sequential_quadratic_method.h"

namespace kinegraph::inline solvers_internal {

namespace {

constexpr int kLargestDimension = 200;  ///< of problems with full matrices
constexpr int kActivePasses = 3;        ///< number of quadratic programs per step, to find the active set
constexpr double kMinSlope = 1e-4;      ///< smallest slope, in units of the variables, for any tolerance
constexpr int kMaxTinySteps = 50;       ///< at points with a larger slope

/// Relaxes a program by one more variable in [0, 1]: the share of the violation at 0 that the first `rows` constraints
/// keep. The cost is half of `weight` times its square. The program is feasible if 0 fulfills the other constraints.
QuadraticProgram relax(const QuadraticProgram& program, int rows, double weight) {
  const Eigen::Index n = program.g.size(), m = program.b.size();
  QuadraticProgram out{MatrixXd::Zero(n + 1, n + 1), VectorXd::Zero(n + 1), MatrixXd::Zero(m + 2, n + 1),
                       VectorXd::Zero(m + 2), program.equalities};
  out.H.topLeftCorner(n, n) = program.H;
  out.H(n, n) = weight;
  out.g.head(n) = program.g;
  out.A.topLeftCorner(m, n) = program.A;
  out.b.head(m) = program.b;
  for (int j = 0; j < rows; ++j) {
    if (j < program.equalities || program.b[j] > 0.) out.A(j, n) = -program.b[j];
  }
  out.A(m, n) = -1.;
  out.A(m + 1, n) = 1.;
  out.b[m + 1] = -1.;
  return out;
}

}  // namespace

SequentialQuadratic::SequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                         const EvaluationCallback& callback)
    : nlp_(nlp),
      options_(options),
      function_(nlp, x0, options, callback),
      constraints_(function_.constraints()),
      equalities_(function_.equalities()),
      lower_(function_.lower()),
      upper_(function_.upper()),
      here_(function_.makePoint()),
      trial_(here_),
      tolerance_(options.constraintTolerance()),
      knows_curvature_(costCurvature(nlp, x0) == CostCurvature::known) {
  here_.x = function_.clip(x0);
  for (VectorXd* v : {&lambda_, &weights_, &row_scale_}) v->setZero(Eigen::Index(constraints_.size()));
}

SolverResult SequentialQuadratic::run(const VectorXd& dual) {
  for (Eigen::Index j = 0; knows_curvature_ && dual.size() == here_.phi.size() && j < lambda_.size(); ++j)
    lambda_[j] = dual[constraints_[std::size_t(j)]];
  learning_unit_ = VectorXd::Ones(nlp_.dimension());
  curvature_.reset(learning_unit_);
  if (knows_curvature_) constraint_curvature_.reset(constraints_, nlp_.dimension());
  evaluate(here_);
  function_.requireFiniteStart(here_);
  function_.remember(here_);
  if (!stopped_ && !solvedInOneStep()) iterate();
  return function_.result(status_ == SolverStatus::converged ? here_ : function_.best(), lambda_, status_, message_);
}

/// Computes gradient and Hessian of the costs, and the constraints. Without any information on the curvature of the f
/// costs, the Hessian makes an unconstrained step a tenth of `scale`, or of the units of the variables.
void SequentialQuadratic::linearize(double scale) {
  const int n = nlp_.dimension();
  function_.costGradient(here_.phi, here_.J, gradient_);
  if (knows_curvature_) {
    findHessian(lambda_);
  } else {
    H_ = curvature_.matrix();
    if (curvature_.empty()) {
      function_.generalGradient(here_.J, VectorXd(), old_gradient_);
      const double slope = learning_unit_.cwiseProduct(old_gradient_).lpNorm<Eigen::Infinity>();
      H_.diagonal() =
          std::max(1e-8, 10. * slope / (learns_in_units_ ? 1. : scale)) * learning_unit_.array().inverse().square();
    }
    addSquaredRows(H_);
  }
  VectorXd row_of_J = VectorXd::Zero(n);
  A_.setZero(Eigen::Index(constraints_.size()), n);
  for (int j = 0; j < A_.rows(); ++j) {
    row_of_J.setZero();
    here_.J.addRowTo(constraints_[j], 1., row_of_J);
    row_scale_[j] = 1. / std::max(row_of_J.norm(), 1e-8);
    A_.row(j) = row_scale_[j] * row_of_J.transpose();
  }
}

/// Adds the Gauss-Newton Hessian of the sos costs and violated ineqP costs.
void SequentialQuadratic::addSquaredRows(MatrixXd& H) const {
  VectorXd row_of_J = VectorXd::Zero(nlp_.dimension());
  for (int row : function_.costs()) {
    const ObjectiveType type = nlp_.types()[row];
    if (type != ObjectiveType::sos && !(type == ObjectiveType::ineqP && here_.phi[row] > 0.)) continue;
    row_of_J.setZero();
    here_.J.addRowTo(row, 1., row_of_J);
    H.noalias() += 2. * row_of_J * row_of_J.transpose();
  }
}

QuadraticProgram SequentialQuadratic::makeModel(const VectorXd& c) const {
  const int n = nlp_.dimension(), m = int(constraints_.size());
  const int bounds =
      knows_curvature_ ? 2 * n : int(lower_.array().isFinite().count() + upper_.array().isFinite().count());
  QuadraticProgram program{H_, gradient_, MatrixXd::Zero(m + bounds, n), VectorXd(m + bounds), equalities_};
  program.A.topRows(m) = A_;
  program.b.head(m) = c.cwiseProduct(row_scale_);
  for (int i = 0, row = m; i < n; ++i) {
    if (const double low = lower_[i] - here_.x[i]; std::isfinite(low) || knows_curvature_) {
      program.A(row, i) = -1.;
      program.b[row++] = std::max(low, -radius_ * unit_[i]);
    }
    if (const double high = upper_[i] - here_.x[i]; std::isfinite(high) || knows_curvature_) {
      program.A(row, i) = 1.;
      program.b[row++] = -std::min(high, radius_ * unit_[i]);
    }
  }
  return program;
}

/// Solves min g^T d + 1/2 d^T H d  subject to c + J d = 0 or <= 0 and the bounds. If these contradict each other, the
/// smallest possible share of the violation remains.
SequentialQuadratic::Step SequentialQuadratic::solveQuadratic(const VectorXd& c) {
  const int n = nlp_.dimension(), m = int(constraints_.size());
  QuadraticProgram program = makeModel(c);
  if (knows_curvature_) makeConvex(program);
  Step step;
  QuadraticSolution solution = solve(program, workspace_);
  if (knows_curvature_ &&
      solution.status == QuadraticStatus::infeasible) {  // constraints have priority over the radius
    leaveRadius(program);
    solution = solve(program, workspace_);
  }
  double weight = 1e3 * std::max(1., std::abs(here_.cost));
  for (int attempt = 0; attempt < 4 && m > 0 && (solution.status != QuadraticStatus::solved || step.relaxed >= .9);
       ++attempt) {
    QuadraticSolution relaxed = solve(relax(program, m, weight), relaxed_workspace_);
    weight *= 100.;
    if (relaxed.status != QuadraticStatus::solved) continue;
    solution = std::move(relaxed);
    step.relaxed = std::clamp(solution.x[n], 1e-16, 1.);
  }
  step.found = solution.status == QuadraticStatus::solved;
  step.d = solution.x.head(n);
  step.lambda = solution.multipliers.head(m).cwiseProduct(row_scale_);
  step.linear = c + (A_ * step.d).cwiseQuotient(row_scale_);
  for (int j = 0; knows_curvature_ && j < int(program.b.size()); ++j) {
    if (j < equalities_ || solution.multipliers[j] > 0.) step.active.push_back(j);
  }
  return step;
}

/// Shortens the step, or a correction of it, until the merit function decreases enough. False if it does not.
bool SequentialQuadratic::lineSearch(const Step& step) {
  double slope = gradient_.dot(step.d), reduction = 0.;
  for (int j = 0; j < weights_.size(); ++j) {
    const double reduces = broken(j, here_.c[j]) - broken(j, step.linear[j]);
    if (step.relaxed == 0.)
      weights_[j] = std::max(std::abs(step.lambda[j]), .5 * (weights_[j] + std::abs(step.lambda[j])));
    reduction += reduces * row_scale_[j];
    slope -= weights_[j] * reduces;
  }
  const double curvature = knows_curvature_ ? curvatureAlong(step.d) : step.d.dot(H_ * step.d);
  if (slope > -.5 * curvature && reduction > 0.) {  // larger weights of the violation make this a descent direction
    const double more = (slope + curvature) / reduction;
    for (int j = 0; j < weights_.size(); ++j) weights_[j] += more * row_scale_[j];
    slope = -curvature;
  }
  const double before = merit(here_), noise = 1e-13 * (1. + std::abs(before));
  double alpha = 1.;
  for (int attempt = 0; attempt < 12; ++attempt) {
    if (function_.evals() >= options_.stopEvals) break;
    const double after = tryStep(alpha * step.d);
    if (stopped_) return false;
    if (after <= before + 1e-4 * alpha * slope + noise) {
      if (knows_curvature_) adaptRadius(step, alpha, (after - before) / (slope + .5 * curvature));
      return true;
    }
    const bool finite = std::isfinite(after);
    if (attempt == 0 && finite && !constraints_.empty()) {
      const Step second = solveQuadratic(trial_.c - (A_ * step.d).cwiseQuotient(row_scale_));
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

void SequentialQuadratic::updateCurvature(const EvaluatedPoint& before, const EvaluatedPoint& after) {
  if (knows_curvature_) return constraint_curvature_.update(after.x - before.x, before.J, after.J);
  function_.generalGradient(before.J, lambda_, old_gradient_);
  function_.generalGradient(after.J, lambda_, gradient_);
  curvature_.update(after.x - before.x, gradient_ - old_gradient_);
}

void SequentialQuadratic::iterate() {
  for (int count = 0; !stopped_; ++count) {
    if (function_.evals() >= options_.stopEvals)
      return stop(SolverStatus::limit, cat("limit of ", options_.stopEvals, " evaluations"));
    if (count >= options_.stopInners) return stop(SolverStatus::limit, cat("limit of ", options_.stopInners, " steps"));
    const double x_scale = std::max(1., here_.x.lpNorm<Eigen::Infinity>());
    unit_ = here_.x.cwiseAbs().cwiseMax(1.);
    linearize(x_scale);
    const Step step = findStep();
    const double violation = here_.violation, size = step.d.lpNorm<Eigen::Infinity>();
    double promised = std::abs(gradient_.dot(step.d));
    for (int j = 0; j < lambda_.size(); ++j) promised += std::abs(step.lambda[j] * here_.c[j]);
    const double scale = std::max(1., std::abs(here_.cost));
    if (options_.verbose > 2) {
      logMessage(LogLevel::info,
                 cat("    step ", count, "  evals ", function_.evals(), "  cost ", numberText(here_.cost, 10), "  |d| ",
                     size, "  promised ", promised, "  violation ", violation,
                     !step.found         ? "  (no step)"
                     : step.relaxed > 0. ? "  (relaxed)"
                                         : ""));
    }
    const bool is_tiny = violation <= tolerance_ && step.found &&
                         ((size <= options_.stopTolerance * x_scale &&
                           promised <= std::max(std::pow(options_.stopTolerance, 2), 1e-12) * scale) ||
                          promised <= 1e-14 * scale);
    if (is_tiny && fulfillsFirstOrder(step.lambda, scale)) {
      if (knows_curvature_ && escapesSaddle(step)) continue;
      if (stopped_) return;
      lambda_ = step.lambda;
      return stop(SolverStatus::converged, cat("step ", size, ", its predicted decrease ", promised, ", and violation ",
                                               violation, " are within tolerances"));
    }
    if (is_tiny && restartsCurvatureInUnits()) continue;
    if (is_tiny && ++tiny_steps_ > kMaxTinySteps)
      return stop(SolverStatus::stalled, "steps are tiny although the projected gradient is not");
    if (!step.found || size <= 1e-15 * x_scale || !lineSearch(step)) {
      if (stopped_) return;
      if (function_.evals() >= options_.stopEvals) continue;
      if ((curvature_.empty() && !knows_curvature_) || ++resets_ > 5)
        return stop(SolverStatus::stalled, "no step decreases the objective as predicted");
      curvature_.reset(learning_unit_);
      weights_.setZero();
      continue;
    }
    if (step.relaxed < .1) lambda_ = step.lambda;
    std::swap(here_, trial_);
    updateCurvature(trial_, here_);
    function_.remember(here_);
  }
}

/// Whether the projected gradient of the Lagrangian, with variables in their units, is within the tolerance.
bool SequentialQuadratic::fulfillsFirstOrder(const VectorXd& multipliers, double scale) {
  return slopeInUnits(multipliers) <= std::max(options_.stopTolerance, kMinSlope) * scale;
}

double SequentialQuadratic::slopeInUnits(const VectorXd& multipliers) {
  old_gradient_ = gradient_;
  function_.addConstraintGradient(here_.J, multipliers, old_gradient_);
  const VectorXd down = unit_.cwiseProduct(old_gradient_), x = here_.x.cwiseQuotient(unit_);
  return ((x - down).cwiseMax(lower_.cwiseQuotient(unit_)).cwiseMin(upper_.cwiseQuotient(unit_)) - x)
      .lpNorm<Eigen::Infinity>();
}

/// Restarts the curvature estimate in the units of the variables, if a wrong scale may cause tiny steps. Only once.
bool SequentialQuadratic::restartsCurvatureInUnits() {
  if (knows_curvature_ || learns_in_units_) return false;
  learns_in_units_ = true;
  learning_unit_ = unit_;
  curvature_.reset(learning_unit_);
  return true;
}

SequentialQuadratic::Step SequentialQuadratic::findStep() {
  holds_tight_only_ = false;
  Step step = solveQuadratic(here_.c);
  if (!knows_curvature_) return step;
  // The expected active set decides how an indefinite Hessian is convexified.
  for (int pass = 0; pass < kActivePasses && step.found && step.active != active_; ++pass) {
    active_ = step.active;
    step = solveQuadratic(here_.c);
  }
  if (step.found && !leadsDown(step)) {
    holds_tight_only_ = true;
    step = solveQuadratic(here_.c);
  }
  return step;
}

CostCurvature costCurvature(Nlp& nlp, const VectorXd& x) {
  const auto& types = nlp.types();
  const int n = nlp.dimension();
  if (std::find(types.begin(), types.end(), ObjectiveType::f) == types.end()) return CostCurvature::squares;
  if (n == 0 || n > kLargestDimension) return CostCurvature::large;
  MatrixXd hessian = MatrixXd::Zero(n, n);
  if (!nlp.addCostHessian(x, hessian)) return CostCurvature::unknown;
  return nlp.curvedRows().empty() && ConstraintCurvature::canHold(types.size(), n) ? CostCurvature::known
                                                                                   : CostCurvature::large;
}

SolverResult solveSequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const EvaluationCallback& callback, const VectorXd& dual) {
  return SequentialQuadratic(nlp, x0, options, callback).run(dual);
}

}  // namespace kinegraph::inline solvers_internal
