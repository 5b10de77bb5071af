#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/algebra/indefinite.h"
#include "kinegraph/solvers/methods/quadratic_step.h"
#include "kinegraph/solvers/methods/sequential_quadratic_method.h"

// Sequential quadratic programming with a known, possibly indefinite Hessian of the costs.

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kLongestStep = 1.;  ///< length of a step in a direction without curvature, in units of |x| and 1
constexpr double kRegularization =
    1e-8;  ///< added to a Hessian without a successful step, in units of its largest entry,
constexpr double kMoreRegularization = 100.;  ///< times this factor per failure
constexpr double kTight = 1e-7;               ///< distance at which a constraint counts as tight
constexpr double kStrong = 1e-7;              ///< multiplier that makes a constraint active, in units of the gradient
constexpr double kSaddle = 1e-6;              ///< relevant negative curvature, in units of the largest
constexpr double kFirstLength = .5;           ///< of a step away from a saddle, in units of |x| and 1
constexpr double kShorter = .1;               ///< factor of this length if the costs do not decrease
constexpr int kLengths = 5;                   ///< number of lengths
constexpr double kFall = .1;                  ///< accepted share of the decrease that the curvature predicts
constexpr int kMaxSaddles = 30;
constexpr double kProbeLength = .01;  ///< of a step that probes the curvature of constraints, in units of |x| and 1
constexpr int kMaxProbes = 3;

constexpr double kNoRadius = 1e10;        ///< replaces an infinite one
constexpr double kFirstRadius = 1.;       ///< of steps, in units of |x| and 1,
constexpr double kLeastRadius = 1e-4;     ///< and the least one
constexpr double kPoor = .1, kGood = .7;  ///< ratios of actual and predicted decrease that shrink or grow the radius
constexpr double kAtEdge = .9, kRadiusGrowth = 2., kRadiusFall = .5;

}  // namespace

/// Moves to the solution of the quadratic program at x, if that solves the problem.
bool SequentialQuadratic::solvedInOneStep() {
  if (!knows_curvature_) return false;
  radius_ = kFirstRadius;
  if (options_.stopEvals < 2) return false;
  const std::optional<QuadraticStep> step = quadraticStep(function_, here_.x, here_.phi, here_.J);
  if (!step) return false;
  trial_.x = step->x;
  evaluate(trial_);
  if (stopped_) return true;
  if (!trial_.finite || !isSolution(function_, trial_.x, trial_.phi, trial_.J, step->multipliers)) return false;
  std::swap(here_, trial_);
  lambda_ = step->multipliers;
  stop(SolverStatus::converged, "the problem is quadratic; one step solves it");
  return true;
}

/// Computes the Hessian of the Lagrangian at x.
void SequentialQuadratic::findHessian(const VectorXd& multipliers) {
  W_.setZero(nlp_.dimension(), nlp_.dimension());
  nlp_.addCostHessian(here_.x, W_);
  W_ = (.5 * (W_ + W_.transpose())).eval();
  constraint_curvature_.addTo(W_, multipliers);
  addSquaredRows(W_);
  H_ = W_;
}

/// Returns the least curvature that limits steps to a useful length, from the projected slope with variables in their
/// units.
double SequentialQuadratic::leastCurvature() { return std::max(1e-10, slopeInUnits(lambda_) / kLongestStep); }

/// Convexifies the Hessian along the active constraints of the last program, or only the tight ones of these if the
/// step led uphill.
void SequentialQuadratic::makeConvex(QuadraticProgram& program) {
  MatrixXd A(0, here_.x.size());
  VectorXd b(Eigen::Index(active_.size()));
  for (int j : active_) {
    if (holds_tight_only_ && j >= equalities_ &&
        program.b[j] < -kTight * std::max(1., here_.x.lpNorm<Eigen::Infinity>()))
      continue;
    const Eigen::RowVectorXd row = program.A.row(j).cwiseProduct(unit_.transpose());
    b[A.rows()] = program.b[j] / row.norm();
    appendRow(A, row / row.norm());
  }
  if (resets_ > 0)
    W_.diagonal().array() += kRegularization * std::pow(kMoreRegularization, resets_) * W_.cwiseAbs().maxCoeff();
  const QuadraticFunction convex = convexified(unit_.asDiagonal() * W_ * unit_.asDiagonal(),
                                               unit_.cwiseProduct(gradient_), A, b.head(A.rows()), leastCurvature());
  const VectorXd inverse = unit_.cwiseInverse();
  H_ = inverse.asDiagonal() * convex.H * inverse.asDiagonal();
  program.H = H_;
  program.g = inverse.cwiseProduct(convex.g);
}

/// Whether costs and violations, weighted by the multipliers, decrease along the step to first order.
bool SequentialQuadratic::leadsDown(const Step& step) const {
  double slope = gradient_.dot(step.d);
  for (int j = 0; j < step.lambda.size(); ++j)
    slope -= std::abs(step.lambda[j]) * (broken(j, here_.c[j]) - broken(j, step.linear[j]));
  return slope < 0.;
}

/// Removes the radius, so that only the bounds limit the step.
void SequentialQuadratic::leaveRadius(QuadraticProgram& program) const {
  for (int i = 0, row = int(constraints_.size()); i < int(here_.x.size()); ++i) {
    program.b[row++] = std::max(lower_[i] - here_.x[i], -kNoRadius * unit_[i]);
    program.b[row++] = -std::min(upper_[i] - here_.x[i], kNoRadius * unit_[i]);
  }
}

/// Adapts the radius to the accuracy of the model.
void SequentialQuadratic::adaptRadius(const Step& step, double alpha, double ratio) {
  const double size = step.d.cwiseQuotient(unit_).lpNorm<Eigen::Infinity>();
  if (alpha < 1. || ratio < kPoor)
    radius_ = std::max(kLeastRadius, std::min(radius_, alpha < 1. ? alpha * size : .5 * size));
  else if (ratio > kGood && size > kAtEdge * radius_)
    radius_ *= kRadiusGrowth;
}

/// Returns the curvature along a step for the merit function, at least a small positive number.
double SequentialQuadratic::curvatureAlong(const VectorXd& d) const {
  return std::max(d.dot(W_ * d), 1e-8 * d.dot(H_ * d));
}

/// Returns the constraints on directions at a point that fulfills the first-order conditions.
Restriction SequentialQuadratic::restriction(const Step& step) const {
  const QuadraticProgram program = makeModel(here_.c);
  const double strong = kStrong * std::max(1e-3, gradient_.lpNorm<Eigen::Infinity>()),
               room = std::max(1., here_.x.lpNorm<Eigen::Infinity>());
  VectorXd rest = gradient_;  // balanced by bounds
  function_.addConstraintGradient(here_.J, step.lambda, rest);
  Restriction rows{MatrixXd(0, here_.x.size()), MatrixXd(0, here_.x.size())};
  for (int j = 0; j < int(program.b.size()); ++j) {
    const bool is_constraint = j < int(constraints_.size());
    if (j >= equalities_ && program.b[j] < -kTight * room) continue;
    const double multiplier = is_constraint ? step.lambda[j] / row_scale_[j] : -program.A.row(j).dot(rest);
    appendRow(j < equalities_ || multiplier > strong ? rows.fixed : rows.tight, program.A.row(j));
  }
  return rows;
}

/// Probes the curvature of the constraints by short steps in directions without observations.
void SequentialQuadratic::probeConstraints(const Step& step) {
  Restriction rows = restriction(step);
  MatrixXd observed = constraint_curvature_.observed(step.lambda);
  if (observed.rows() == 0) return;
  for (Eigen::Index k = 0; k < rows.fixed.rows(); ++k) appendRow(observed, rows.fixed.row(k));
  const MatrixXd unobserved = nullSpace(observed);
  const double length = kProbeLength * std::max(1., here_.x.lpNorm<Eigen::Infinity>());
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(unobserved.cols(), kMaxProbes); ++k) {
    if (function_.evals() >= options_.stopEvals) return;
    VectorXd d = length * unobserved.col(k);
    if ((function_.clip(here_.x + d) - here_.x).norm() < .5 * length) d = -d;
    tryStep(d);
    if (stopped_) return;
    if (trial_.finite) updateCurvature(here_, trial_);
  }
}

/// Returns the shortest step that brings the active constraints, now at c, back to zero, to first order.
VectorXd SequentialQuadratic::onActiveRows(const VectorXd& c, const Step& step) const {
  std::vector<int> rows;
  for (int j = 0; j < int(c.size()); ++j) {
    if (j < equalities_ || step.lambda[j] > 0. || c[j] > 0.) rows.push_back(j);
  }
  if (rows.empty()) return VectorXd::Zero(here_.x.size());
  const MatrixXd A = A_(rows, Eigen::all);
  const VectorXd b = c.cwiseProduct(row_scale_)(rows);
  return -A.completeOrthogonalDecomposition().solve(b);
}

/// Tries steps along a direction of negative curvature, and accepts one that decreases the merit function by a share of
/// the prediction. False if there is none. The evaluations update the curvature of the constraints in any case.
bool SequentialQuadratic::descendsAlong(const VectorXd& direction, const Step& step) {
  const QuadraticProgram program = makeModel(here_.c);
  double length = kFirstLength * std::max(1., here_.x.lpNorm<Eigen::Infinity>());
  for (int j = equalities_; j < int(program.b.size()); ++j) {
    const double slope = program.A.row(j).dot(direction);
    if (slope > 1e-9) length = std::min(length, std::max(0., -program.b[j]) / slope);
  }
  const double before = merit(here_);
  for (int attempt = 0; attempt < kLengths && length > 0.; ++attempt, length *= kShorter) {
    if (function_.evals() >= options_.stopEvals) return false;
    double after = tryStep(length * direction);
    if (stopped_) return false;
    if (!trial_.finite) continue;
    updateCurvature(here_, trial_);
    findHessian(step.lambda);
    const double curvature = direction.dot(W_ * direction);
    if (!(curvature < 0.)) return false;
    const double most = before + .5 * kFall * curvature * length * length;
    if (after > most && !constraints_.empty() && function_.evals() < options_.stopEvals) {
      const VectorXd back = onActiveRows(trial_.c, step);
      if (back.norm() > kTight * length) after = tryStep(trial_.x - here_.x + back);
      if (stopped_) return false;
    }
    if (after > most) continue;
    std::swap(here_, trial_);
    updateCurvature(trial_, here_);
    function_.remember(here_);
    return true;
  }
  return false;
}

/// Leaves a saddle or maximum at which the first-order conditions hold. True if a step was accepted.
bool SequentialQuadratic::escapesSaddle(const Step& step) {
  weights_ = weights_.cwiseMax(2. * step.lambda.cwiseAbs());
  probeConstraints(step);
  for (; saddles_ < kMaxSaddles && !stopped_; ++saddles_) {
    findHessian(step.lambda);
    const MatrixXd before = W_;
    const double least = kSaddle * std::max(1e-10, W_.cwiseAbs().maxCoeff());
    const std::optional<VectorXd> direction = negativeCurvature(W_, restriction(step), least);
    if (!direction) return false;
    if (descendsAlong(*direction, step)) {
      lambda_ = step.lambda;
      return true;
    }
    if (direction->dot(W_ * *direction) < .5 * direction->dot(before * *direction)) return false;
  }
  return false;
}

}  // namespace kinegraph::inline solvers_internal
