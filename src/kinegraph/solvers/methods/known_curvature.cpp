#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/solvers/algebra/indefinite.h"
#include "kinegraph/solvers/methods/quadratic_step.h"
#include "kinegraph/solvers/methods/sequential_quadratic_method.h"

// What the sequence of quadratic programs does with a Hessian that the problem tells, and that may be indefinite.

namespace kinegraph {

namespace {

constexpr double kLongestStep = 1.;  ///< a direction without curvature is followed so far, in units of |x| and 1
constexpr double kRegularization =
    1e-8;  ///< of a Hessian with which no step was found, as a part of its largest entry,
constexpr double kMoreRegularization = 100.;  ///< times this for every time that none was
constexpr double kTouching = 1e-7;            ///< distance at which a row counts as touched
constexpr double kStrong = 1e-7;              ///< multiplier that holds a row, as a part of the gradient
constexpr double kSaddle = 1e-6;              ///< negative curvature that is worth a look, as a part of the largest
constexpr double kFirstLength = .5;           ///< of a step away from a saddle, in units of |x| and 1
constexpr double kShorter = .1;               ///< its factor where the costs do not fall
constexpr int kLengths = 5;                   ///< so many are tried
constexpr double kFall = .1;                  ///< part of the decrease that the curvature promises, to be taken
constexpr int kMostSaddles = 30;
constexpr double kLook = .01;  ///< of a step that only looks how constraints are curved, in units of |x| and 1
constexpr int kMostLooks = 3;

constexpr double kNoRadius = 1e10;        ///< in place of one that is infinite
constexpr double kFirstRadius = 1.;       ///< of steps, in units of |x| and 1,
constexpr double kLeastRadius = 1e-4;     ///< and the least one
constexpr double kPoor = .1, kGood = .7;  ///< ratios of the actual and the promised decrease: less, or more radius
constexpr double kAtEdge = .9, kRadiusGrowth = 2., kRadiusFall = .5;

}  // namespace

/// Goes to the solution of the quadratic program here, if that is the solution of the problem.
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

/// Of the Lagrangian, here.
void SequentialQuadratic::findHessian(const VectorXd& multipliers) {
  W_.setZero(nlp_.dimension(), nlp_.dimension());
  nlp_.addCostHessian(here_.x, W_);
  W_ = (.5 * (W_ + W_.transpose())).eval();
  constraint_curvature_.addTo(W_, multipliers);
  addSquaredRows(W_);
  H_ = W_;
}

/// Where there is less curvature, steps would be too long to say anything: by the slope that is left to go down, with
/// variables in their units.
double SequentialQuadratic::leastCurvature() { return std::max(1e-10, slopeInUnits(lambda_) / kLongestStep); }

/// Rows that hold the step are those that were active in the last program; only touched ones, where others led uphill.
void SequentialQuadratic::makeConvex(QuadraticProgram& program) {
  MatrixXd A(0, here_.x.size());
  VectorXd b(Eigen::Index(active_.size()));
  for (int j : active_) {
    if (holds_touched_only_ && j >= equalities_ &&
        program.b[j] < -kTouching * std::max(1., here_.x.lpNorm<Eigen::Infinity>()))
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

/// Do costs and violations, weighted by the multipliers, fall along the step at first?
bool SequentialQuadratic::leadsDown(const Step& step) const {
  double slope = gradient_.dot(step.d);
  for (int j = 0; j < step.lambda.size(); ++j)
    slope -= std::abs(step.lambda[j]) * (broken(j, here_.c[j]) - broken(j, step.linear[j]));
  return slope < 0.;
}

/// Only the bounds limit the step then.
void SequentialQuadratic::leaveRadius(QuadraticProgram& program) const {
  for (int i = 0, row = int(constraints_.size()); i < int(here_.x.size()); ++i) {
    program.b[row++] = std::max(lower_[i] - here_.x[i], -kNoRadius * unit_[i]);
    program.b[row++] = -std::min(upper_[i] - here_.x[i], kNoRadius * unit_[i]);
  }
}

/// Steps may be as long as they do what the model says.
void SequentialQuadratic::adaptRadius(const Step& step, double alpha, double ratio) {
  const double size = step.d.cwiseQuotient(unit_).lpNorm<Eigen::Infinity>();
  if (alpha < 1. || ratio < kPoor)
    radius_ = std::max(kLeastRadius, std::min(radius_, alpha < 1. ? alpha * size : .5 * size));
  else if (ratio > kGood && size > kAtEdge * radius_)
    radius_ *= kRadiusGrowth;
}

/// What the merit function may count on: at least a little.
double SequentialQuadratic::curvatureAlong(const VectorXd& d) const {
  return std::max(d.dot(W_ * d), 1e-8 * d.dot(H_ * d));
}

/// What limits directions at a point that fulfills the first-order conditions.
Restriction SequentialQuadratic::restriction(const Step& step) const {
  const QuadraticProgram program = makeModel(here_.c);
  const double strong = kStrong * std::max(1e-3, gradient_.lpNorm<Eigen::Infinity>()),
               room = std::max(1., here_.x.lpNorm<Eigen::Infinity>());
  VectorXd rest = gradient_;  // what bounds have to hold
  function_.addConstraintGradient(here_.J, step.lambda, rest);
  Restriction rows{MatrixXd(0, here_.x.size()), MatrixXd(0, here_.x.size())};
  for (int j = 0; j < int(program.b.size()); ++j) {
    const bool is_constraint = j < int(constraints_.size());
    if (j >= equalities_ && program.b[j] < -kTouching * room) continue;
    const double multiplier = is_constraint ? step.lambda[j] / row_scale_[j] : -program.A.row(j).dot(rest);
    appendRow(j < equalities_ || multiplier > strong ? rows.held : rows.touched, program.A.row(j));
  }
  return rows;
}

/// Looks at the constraints in directions in which they were never seen, a little.
void SequentialQuadratic::lookAround(const Step& step) {
  Restriction rows = restriction(step);
  MatrixXd seen = constraint_curvature_.seen(step.lambda);
  if (seen.rows() == 0) return;
  for (Eigen::Index k = 0; k < rows.held.rows(); ++k) appendRow(seen, rows.held.row(k));
  const MatrixXd unseen = nullSpace(seen);
  const double length = kLook * std::max(1., here_.x.lpNorm<Eigen::Infinity>());
  for (Eigen::Index k = 0; k < std::min<Eigen::Index>(unseen.cols(), kMostLooks); ++k) {
    if (function_.evals() >= options_.stopEvals) return;
    VectorXd d = length * unseen.col(k);
    if ((function_.clip(here_.x + d) - here_.x).norm() < .5 * length) d = -d;
    tryStep(d);
    if (stopped_) return;
    if (trial_.finite) learnCurvature(here_, trial_);
  }
}

/// The shortest step that brings the active constraints, which are c now, back to zero, to first order.
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

/// Follows a direction with negative curvature until the merit function is less by part of what the curvature promises,
/// and takes the step. False if it is not; what was seen of the constraints is learnt in any case.
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
    learnCurvature(here_, trial_);
    findHessian(step.lambda);
    const double curvature = direction.dot(W_ * direction);
    if (!(curvature < 0.)) return false;
    const double most = before + .5 * kFall * curvature * length * length;
    if (after > most && !constraints_.empty() && function_.evals() < options_.stopEvals) {
      const VectorXd back = onActiveRows(trial_.c, step);
      if (back.norm() > kTouching * length) after = tryStep(trial_.x - here_.x + back);
      if (stopped_) return false;
    }
    if (after > most) continue;
    std::swap(here_, trial_);
    learnCurvature(trial_, here_);
    function_.remember(here_);
    return true;
  }
  return false;
}

/// True if a step away was taken, as the point is a saddle or a maximum where the first-order conditions hold.
bool SequentialQuadratic::leavesSaddle(const Step& step) {
  weights_ = weights_.cwiseMax(2. * step.lambda.cwiseAbs());
  lookAround(step);
  for (; saddles_ < kMostSaddles && !stopped_; ++saddles_) {
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

}  // namespace kinegraph
