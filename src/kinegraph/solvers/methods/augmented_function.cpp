#include <algorithm>
#include <cmath>

#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

// The augmented Lagrangian as a function: value, multipliers, errors and local model.

namespace kinegraph::inline solvers_internal {

/// Computes lambda + mu c, clipped at zero for inequalities.
void AugmentedLagrangian::findMultipliers(const VectorXd& c, VectorXd& t) const {
  t = lambda_ + penalty_.value() * c;
  t.tail(t.size() - equalities_) = t.tail(t.size() - equalities_).cwiseMax(0.);
}

/// Returns the sum of the squares of lambda + mu c, clipped at zero for inequalities.
double AugmentedLagrangian::squaredMultipliers(const VectorXd& c) const {
  const Eigen::Index inequalities = c.size() - equalities_;
  const double mu = penalty_.value();
  return (lambda_.head(equalities_) + mu * c.head(equalities_)).squaredNorm() +
         (lambda_.tail(inequalities) + mu * c.tail(inequalities)).cwiseMax(0.).squaredNorm();
}

/// Returns the augmented Lagrangian without the constant -lambda^2 / (2 mu).
double AugmentedLagrangian::lagrangian(const EvaluatedPoint& point) const {
  return point.finite ? point.cost + squaredMultipliers(point.c) / (2. * penalty_.value()) : kInfinity;
}

/// Returns the violation that the model predicts after its step.
double AugmentedLagrangian::linearizedViolation() const {
  const VectorXd& c = model_.linearized();
  const Eigen::Index inequalities = c.size() - equalities_;
  double worst = equalities_ > 0 ? c.head(equalities_).lpNorm<Eigen::Infinity>() : 0.;
  if (inequalities > 0) worst = std::max(worst, c.tail(inequalities).maxCoeff());
  return worst;
}

/// Returns the sum of squared violations.
double AugmentedLagrangian::squaredViolation(const VectorXd& c) const {
  return c.head(equalities_).squaredNorm() + c.tail(c.size() - equalities_).cwiseMax(0.).squaredNorm();
}

/// Returns the largest entry of the projected gradient of the Lagrangian.
double AugmentedLagrangian::gradientNorm(const EvaluatedPoint& point) {
  function_.costGradient(point.phi, point.J, gradient_);
  findMultipliers(point.c, multipliers_);
  function_.addConstraintGradient(point.J, multipliers_, gradient_);
  return ((point.x - gradient_).cwiseMax(lower_).cwiseMin(upper_) - point.x).lpNorm<Eigen::Infinity>();
}

/// Returns the error of feasibility and complementarity: the largest |c| of equalities and |max(c, -lambda / mu)| of
/// inequalities.
double AugmentedLagrangian::constraintError() const {
  const Eigen::Index inequalities = here_.c.size() - equalities_;
  double worst = equalities_ > 0 ? here_.c.head(equalities_).lpNorm<Eigen::Infinity>() : 0.;
  if (inequalities > 0) {
    const double least = -1. / penalty_.value();
    worst = std::max(worst,
                     here_.c.tail(inequalities).cwiseMax(least * lambda_.tail(inequalities)).lpNorm<Eigen::Infinity>());
  }
  return worst;
}

/// Returns the largest entry of the gradient of general costs; 0 for sums of squares.
double AugmentedLagrangian::steepness() {
  if (!function_.hasGeneralCosts()) return 0.;
  function_.generalGradient(here_.J, VectorXd(), gradient_);
  return gradient_.lpNorm<Eigen::Infinity>();
}

void AugmentedLagrangian::linearize() {
  model_.setJacobian(here_.J);
  learns_curvature_ = !model_.setCosts(nlp_, here_.x, here_.phi, &curvature_.matrix());
}

/// Adds the curvature of the constraints to the model, if the problem knows it.
void AugmentedLagrangian::addCurvature() {
  if (learns_curvature_ || nlp_.curvedRows().empty()) return;
  function_.moveTo(here_);
  model_.addCurvature(nlp_, lambda_);
}

/// Estimates the curvature of the Lagrangian from accepted steps if the problem does not know that of its f terms.
void AugmentedLagrangian::learnCurvature(const EvaluatedPoint& before) {
  if (!learns_curvature_) return;
  findMultipliers(model_.linearized(), next_lambda_);
  VectorXd old_gradient;
  function_.generalGradient(before.J, next_lambda_, old_gradient);
  function_.generalGradient(here_.J, next_lambda_, gradient_);
  curvature_.update(here_.x - before.x, gradient_ - old_gradient);
}

/// Sets the box of the step from the bounds and the radius.
void AugmentedLagrangian::makeBox() {
  low_ = (lower_ - here_.x).cwiseMax(-radius_.value());
  high_ = (upper_ - here_.x).cwiseMin(radius_.value());
}

}  // namespace kinegraph::inline solvers_internal
