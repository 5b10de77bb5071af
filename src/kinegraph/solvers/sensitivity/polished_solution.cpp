#include "kinegraph/solvers/sensitivity/polished_solution.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph::inline solvers_internal {

namespace {

using enum ObjectiveType;

constexpr double kSettled = 1e-7;        // length of a step: the error is then of the size of its square
constexpr double kSettledPull = 1e-6;    // change of multipliers, relative to the largest gradient
constexpr double kShort = 1e-2;          // distance over which curvature counts as a gradient
constexpr double kStepAccuracy = 1e-10;  // of the linear system, relative
constexpr int kMaxSteps = 15;
constexpr double kNear = 1e-3;      // distance (residual by norm of its gradient) at which a constraint may be active
constexpr double kTouching = 1e-6;  // distance at which it is active
constexpr double kNoForce = 1e-6;   // multiplier that counts as zero, relative to the gradients
constexpr double kTight = 1e-8;     // tolerances of the additional solve

bool isCost(ObjectiveType type) { return type == f || type == sos || type == ineqP; }
bool isInequality(ObjectiveType type) { return type == ineq || type == ineqB; }

bool offersCostHessian(Nlp& nlp, const VectorXd& x) {
  bool any = false;
  for (std::size_t row = 0; row < nlp.types().size(); ++row)
    any = any || (nlp.types()[row] == f && !nlp.isLinear(int(row)));
  MatrixXd H = any ? MatrixXd(MatrixXd::Zero(x.size(), x.size())) : MatrixXd();
  return any && nlp.addCostHessian(x, H);
}

}  // namespace

PolishedSolution::PolishedSolution(Nlp& nlp, const VectorXd& given, const VectorXd& multipliers,
                                   const std::vector<char>& is_near, bool holds_weak)
    : x(given.cwiseMax(nlp.lower()).cwiseMin(nlp.upper())),
      phi(nlp.types().size()),
      dual(multipliers),
      weights(VectorXd::Zero(Eigen::Index(nlp.types().size()))),
      J(nlp.makeJacobian()),
      fixed(std::size_t(nlp.dimension()), false),
      nlp_(nlp),
      is_near_(is_near),
      holds_weak_(holds_weak),
      has_costs_(std::ranges::any_of(nlp.types(), isCost)),
      knows_costs_(offersCostHessian(nlp, x)),
      system_(nlp, J, knows_costs_),
      curvature_(nlp),
      bound_multipliers_(VectorXd::Zero(nlp.dimension())) {
  if (dual.size() == 0) {
    dual.setZero(phi.size());
    is_near_.assign(nlp.types().size(), true);
  }
  if (!has_costs_) dual.setZero();  // all constraints are weakly active
  const VectorXd start = x;
  if (!converge()) {
    x = start;
    solveTightly();
    if (!converge())
      throw Error(
          "the derivatives of the solution are not known: Newton's method on the optimality conditions converges "
          "neither "
          "from the result nor after further steps of the solver");
  }
  classify();
}

void PolishedSolution::evaluate() {
  nlp_.evaluate(x, phi, &J);
  ++evals;
  if (!phi.allFinite()) throw Error("the solution has no derivatives: its residuals are not finite");
}

/// Computes the weights of the gradients and the gradient of the Lagrangian.
void PolishedSolution::weigh() {
  squared_.clear();
  gradient_.setZero(x.size());
  for (int row = 0; row < int(phi.size()); ++row) {
    const ObjectiveType type = nlp_.types()[std::size_t(row)];
    double weight = 0.;
    if (type == f) {
      weight = 1.;
    } else if (type == sos || (type == ineqP && phi[row] > 0.)) {
      weight = 2. * phi[row];
      if (!J.zero_row[std::size_t(row)]) squared_.push_back(row);
    } else if (type == eq || isInequality(type)) {
      weight = dual[row];
    }
    weights[row] = weight;
    if (weight != 0. && !J.zero_row[std::size_t(row)]) J.addRowTo(row, weight, gradient_);
  }
}

/// Computes H at the last evaluated point.
void PolishedSolution::linearize() {
  BandAlgebra& H = system_.begin(J, squared_);
  if (knows_costs_) {
    MatrixXd costs = MatrixXd::Zero(x.size(), x.size());
    nlp_.addCostHessian(x, costs);
    for (int j = 0; j < costs.cols(); ++j) {
      for (int i = j; i < costs.rows(); ++i) H.addEntry(i, j, costs(i, j));
    }
  }
  curvature_.addTo(H, x, weights, J, knows_costs_);
  curvature_scale_ = system_.largestCurvature();
  if (curvature_scale_ == 0.) curvature_scale_ = 1.;
}

/// Selects the active constraints: those with positive multipliers or violations, and at first also those that may be
/// active. False if the set has not changed.
bool PolishedSolution::chooseActive(bool is_first) {
  std::vector<int> now;
  deactivated_ = false;
  for (int row = 0; row < int(phi.size()); ++row) {
    const ObjectiveType type = nlp_.types()[std::size_t(row)];
    const double norm = system_.norm(row);
    if (type == eq && (norm > 0. || dual[row] != 0.)) now.push_back(row);
    if (!isInequality(type) || norm == 0.) continue;
    const double slack = phi[row] / norm, force = dual[row] * norm;
    const bool may_be = is_first && (force > 0. || (is_near_[std::size_t(row)] && slack > -kNear));
    if (may_be || force + curvature_scale_ * slack > 0.)
      now.push_back(row);
    else
      deactivated_ = std::exchange(dual[row], 0.) != 0. || deactivated_;
  }
  std::vector<char> held(fixed.size());
  for (int i = 0; i < int(x.size()); ++i) {
    const double pull = -gradient_[i], low = nlp_.lower()[i], high = nlp_.upper()[i];
    held[std::size_t(i)] =
        low == high || pull + curvature_scale_ * (x[i] - high) > 0. || pull + curvature_scale_ * (x[i] - low) < 0.;
  }
  const bool changed = now != active || held != fixed;
  active = std::move(now);
  fixed = std::move(held);
  return changed;
}

/// Makes one step of Newton's method. False if it is not finite.
bool PolishedSolution::step() {
  VectorXd b(active.size()), dx = VectorXd::Zero(x.size()), change(active.size());
  for (std::size_t k = 0; k < active.size(); ++k) b[Eigen::Index(k)] = -phi[active[k]];
  for (int i = 0; i < int(x.size()); ++i) {
    if (!fixed[std::size_t(i)]) continue;
    const double pull = -gradient_[i];
    const bool is_upper = pull + curvature_scale_ * (x[i] - nlp_.upper()[i]) > 0.;
    dx[i] = (is_upper ? nlp_.upper()[i] : nlp_.lower()[i]) - x[i];
  }
  if (deactivated_) weigh();
  system_.solve(-gradient_, b, dx, change, kStepAccuracy);
  moved_ = dx.size() > 0 ? dx.lpNorm<Eigen::Infinity>() : 0.;
  if (!std::isfinite(moved_)) return false;
  x += dx;
  last_step_ = std::move(dx);
  double changed = 0.;
  force_scale_ = 0.;
  for (std::size_t k = 0; has_costs_ && k < active.size(); ++k) {
    dual[active[k]] += change[Eigen::Index(k)];
    weights[active[k]] = dual[active[k]];
    changed = std::max(changed, std::abs(change[Eigen::Index(k)]) * system_.norm(active[k]));
  }
  for (int row = 0; row < int(phi.size()); ++row)
    force_scale_ = std::max(force_scale_, std::abs(weights[row]) * system_.norm(row));
  force_scale_ = std::max(force_scale_, kShort * curvature_scale_);
  multipliers_settled_ = changed <= kSettledPull * force_scale_;
  return true;
}

bool PolishedSolution::converge() {
  double before = std::numeric_limits<double>::infinity();
  int worse = 0;
  for (int i = 0; i < kMaxSteps; ++i) {
    evaluate();
    weigh();
    linearize();
    const bool changed = chooseActive(i == 0);
    if (!system_.factorize(active, fixed)) return false;
    if (!step()) return false;
    const double size = 1. + x.lpNorm<Eigen::Infinity>();
    if (moved_ <= kSettled * size && multipliers_settled_ && (!changed || i == 0)) {
      // constraints that were only assumed to be active may have negative multipliers
      const auto isNegative = [&](int row) {
        return isInequality(nlp_.types()[std::size_t(row)]) &&
               dual[row] * system_.norm(row) < -kSettledPull * force_scale_;
      };
      if (std::ranges::none_of(active, isNegative)) return true;
    }
    worse = !changed && moved_ > before ? worse + 1 : 0;
    if (worse > 3 || moved_ > 10. * size) return false;
    before = moved_;
  }
  return false;
}

void PolishedSolution::solveTightly() {
  SolverOptions options;
  options.verbose = 0;
  options.stopTolerance = kTight;
  options.stopGTolerance = kTight;
  const SolverResult tight = solveAugmentedLagrangian(nlp_, x, options, dual);
  x = tight.x;
  dual = tight.dual;
  evals += tight.evals;
  std::fill(is_near_.begin(), is_near_.end(), false);
  active.clear();
  std::fill(fixed.begin(), fixed.end(), false);
}

/// Separates strongly from weakly active constraints, at the conditions of the last step.
void PolishedSolution::classify() {
  const double no_force = kNoForce * force_scale_;
  for (int row = 0; row < int(phi.size()); ++row) {
    const double norm = system_.norm(row);
    if (!isInequality(nlp_.types()[std::size_t(row)]) || norm == 0.) continue;
    const bool is_active = std::ranges::binary_search(active, row);
    if ((is_active || phi[row] / norm > -kTouching) && dual[row] * norm <= no_force) weak_rows.push_back(row);
  }
  for (int row = 0; row < int(phi.size()); ++row) {  // exact for such a short step
    if (!J.zero_row[std::size_t(row)]) phi[row] += J.rowTimes(row, last_step_);
  }
  weigh();
  for (int i = 0; i < int(x.size()); ++i) {
    const double low = nlp_.lower()[i], high = nlp_.upper()[i], pull = -gradient_[i];
    if (low == high || std::abs(pull) > no_force) continue;
    if (x[i] - low <= kTouching) weak_lower.push_back(i);
    if (high - x[i] <= kTouching) weak_upper.push_back(i);
  }
  std::vector<int> strong;
  std::ranges::copy_if(active, std::back_inserter(strong),
                       [&](int row) { return holds_weak_ || !std::ranges::binary_search(weak_rows, row); });
  if (holds_weak_) {
    strong.insert(strong.end(), weak_rows.begin(), weak_rows.end());
    std::ranges::sort(strong);
    strong.erase(std::unique(strong.begin(), strong.end()), strong.end());
  }
  std::vector<char> held = fixed;
  for (const std::vector<int>* weak : {&weak_lower, &weak_upper}) {
    for (const int i : *weak) held[std::size_t(i)] = holds_weak_;
  }
  if (strong == active && held == fixed) return;
  active = std::move(strong);
  fixed = std::move(held);
  linearize();
  system_.factorize(active, fixed);
}

}  // namespace kinegraph::inline solvers_internal
