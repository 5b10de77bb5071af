#include "kinegraph/solvers/algebra/semismooth_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/solvers/algebra/band_algebra.h"
#include "kinegraph/solvers/algebra/dense_algebra.h"

namespace kinegraph::inline solvers_internal {

template <class Algebra>
SemismoothModel<Algebra>::SemismoothModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs,
                                          std::vector<int> constraints)
    : LocalFunction<Algebra>(nlp, pattern, costs, std::move(constraints)) {
  const std::size_t m = constraints_.size();
  active_.assign(m, false);
  factored_active_ = active_;
  fixed_.assign(std::size_t(size()), false);
  factored_fixed_ = fixed_;
  for (std::vector<int>* list : {&within_reach_, &out_of_reach_, &active_list_}) list->reserve(m);
  for (Vector* v : {&low_, &high_, &d_, &trial_, &r_, &s_, &Hd_, &Hs_, &trial_Hd_}) *v = algebra_.zeroVector();
  step_.setZero(n_);
  for (VectorXd* v : {&trial_linear_, &step_linear_}) v->setZero(Eigen::Index(m));
}

template <class Algebra>
void SemismoothModel<Algebra>::linearize(const Vector& d, const Problem& problem, VectorXd& linear) const {
  for (int j : within_reach_) linear[j] = problem.c[j] + algebra_.rowTimes(j, d);
}

/// Finds the constraints that matter in the box: inequalities whose multiplier is zero in the whole box do not.
template <class Algebra>
void SemismoothModel<Algebra>::findWithinReach(const Problem& problem) {
  within_reach_.assign(equalities_.begin(), equalities_.end());
  out_of_reach_.clear();
  for (int j : inequalities_) {
    if (problem.lambda[j] + problem.mu * (problem.c[j] + algebra_.largestRise(j, low_, high_)) > 0.) {
      within_reach_.push_back(j);
    } else {
      out_of_reach_.push_back(j);
      active_[j] = false;
    }
  }
}

template <class Algebra>
double SemismoothModel<Algebra>::value(const Vector& d, const Vector& Hd, const VectorXd& linear,
                                       const Problem& problem) const {
  double sum = g_.dot(d) + .5 * d.dot(Hd) + .5 * problem.damping * d.squaredNorm();
  for (int j : within_reach_) {
    const double t = multiplier(j, linear[j], problem);
    sum += t * t / (2. * problem.mu);
  }
  return sum;
}

/// Inequalities out of reach contribute nothing: their multipliers are zero at both ends. Those of zero rows do not
/// change.
template <class Algebra>
double SemismoothModel<Algebra>::decrease(const Problem& problem) const {
  double sum = 0.;
  for (int j : within_reach_) {
    const double before = multiplier(j, problem.c[j], problem), after = multiplier(j, linear_[j], problem);
    sum += (before - after) * (before + after);
  }
  return sum / (2. * problem.mu) - g_.dot(d_) - .5 * d_.dot(Hd_);
}

/// Returns the first column of the factor that changes with the active constraints, fixed variables and weights; the
/// size if none does.
template <class Algebra>
int SemismoothModel<Algebra>::firstChange(const Problem& problem) const {
  if (!factored_ || problem.mu != factored_mu_ || problem.damping != factored_damping_ || fixed_ != factored_fixed_)
    return 0;
  int first = size();
  for (int j : inequalities_) {
    if (active_[j] != factored_active_[j]) first = factored_as_is_ ? std::min(first, algebra_.firstColumn(j)) : 0;
  }
  return first;
}

/// Factorizes H + damping I + mu J_A^T J_A, with the rows of fixed variables replaced by the identity, from column
/// `first` on.
template <class Algebra>
bool SemismoothModel<Algebra>::factorize(const Problem& problem, int first) {
  active_list_.clear();
  for (int j : within_reach_) {
    if (active_[j]) active_list_.push_back(j);
  }
  double extra = 0.;
  for (int attempt = 0; attempt < 12; ++attempt) {
    ++factorizations_;
    factored_as_is_ = extra == 0.;
    if (algebra_.factorize(problem.damping + extra, problem.mu, active_list_, fixed_, attempt == 0 ? first : 0))
      return true;
    if (is_curved_) return false;
    const double magnitude = std::max(1e-6, algebra_.largestEntry());  // curvatures may be negative
    extra = extra == 0. ? 1e-3 * magnitude : 4. * extra;
  }
  return false;
}

/// Computes s = -K^-1 r for the free variables. Variables at a bound that s would move outside are also fixed.
template <class Algebra>
bool SemismoothModel<Algebra>::newtonStep(const Problem& problem) {
  const bool inside = isInside();
  for (bool leaves_box = true; leaves_box;) {
    if (const int first = firstChange(problem); first < size()) {
      factored_ = factorize(problem, first);
      if (!factored_) return false;
      for (int j : inequalities_) factored_active_[j] = active_[j];
      factored_fixed_ = fixed_;
      factored_mu_ = problem.mu;
      factored_damping_ = problem.damping;
    }
    s_ = -r_;
    for (int i = 0; any_fixed_ && i < n_; ++i) {
      if (fixed_[i]) s_[i] = 0.;
    }
    algebra_.solve(s_);
    if (knows_f_ && !factored_as_is_) addNegativeCurvature(problem);
    leaves_box = false;
    for (int i = 0; !inside && i < n_; ++i) {
      if (fixed_[i] || !((d_[i] <= low_[i] && s_[i] < 0.) || (d_[i] >= high_[i] && s_[i] > 0.))) continue;
      fixed_[i] = any_fixed_ = leaves_box = true;
    }
  }
  return true;
}

/// Adds the direction of most negative curvature to s, as far as the box is wide, because the minimum is then at the
/// boundary. Inverse iteration with the shifted matrix finds the direction.
/// Source: More & Sorensen, Computing a trust region step, 1983.
template <class Algebra>
void SemismoothModel<Algebra>::addNegativeCurvature(const Problem& problem) {
  constexpr int kPowers = 8;
  Vector v = algebra_.zeroVector(), Kv = v;
  for (int i = 0; i < n_; ++i) v[i] = fixed_[i] ? 0. : 1. + .1 * double(i % 7);
  for (int power = 0; power < kPowers; ++power) {
    const double length = v.norm();
    if (!(length > 0.)) return;
    v /= length;
    algebra_.solve(v);
  }
  v.normalize();
  algebra_.addHessianProduct(v, Kv);
  double curvature = v.dot(Kv) + problem.damping;
  for (int j : active_list_) curvature += problem.mu * std::pow(algebra_.rowTimes(j, v), 2);
  if (!(curvature < 0.)) return;
  if (v.dot(r_) > 0.) v = -v;
  constexpr double kWidest = 1e6;
  double width = 0.;
  for (int i = 0; i < n_; ++i) width = std::max(width, high_[i] - low_[i]);
  s_ += std::min(width, kWidest) * v;
}

/// Computes J s and H s. If no variable is fixed, H s follows from K s = -r, which is not exact enough for small
/// problems.
template <class Algebra>
void SemismoothModel<Algebra>::findChangesAlongStep(const Problem& problem) {
  for (int j : within_reach_) step_linear_[j] = algebra_.rowTimes(j, s_);
  if (n_ <= kSmall || !factored_as_is_ || any_fixed_) {
    Hs_.setZero();
    return algebra_.addHessianProduct(s_, Hs_);
  }
  Hs_ = -r_ - problem.damping * s_;
  for (int j : within_reach_) {
    if (active_[j]) algebra_.addRowTo(j, -problem.mu * step_linear_[j], Hs_);
  }
}

/// Returns the share of the step s up to the first bound, at most `most`.
template <class Algebra>
double SemismoothModel<Algebra>::lengthToBound(double most) const {
  const auto end = d_ + most * s_;
  if ((end - low_).cwiseMin(high_ - end).minCoeff() >= 0.) return most;
  double room = most;
  for (int i = 0; i < n_; ++i) {
    if (s_[i] < 0.) room = std::min(room, (low_[i] - d_[i]) / s_[i]);
    if (s_[i] > 0.) room = std::min(room, (high_[i] - d_[i]) / s_[i]);
  }
  return room;
}

/// Returns the share of the step s, at most `most`, that minimizes the model: the zero of its slope, which is piecewise
/// linear and increasing. Newton's method with bisection as safeguard. The result is exactly 1 if that is the minimum.
template <class Algebra>
double SemismoothModel<Algebra>::lengthAlong(const Problem& problem, double most) const {
  const double slope = g_.dot(s_) + d_.dot(Hs_) + problem.damping * d_.dot(s_);
  const double curvature = s_.dot(Hs_) + problem.damping * s_.squaredNorm();
  double low = 0., high = most, first = 0., alpha = std::min(1., most);
  for (int iteration = 0; iteration < 30; ++iteration) {
    double at = slope + alpha * curvature, rise = curvature, scale = std::abs(slope);
    for (int j : within_reach_) {
      const double t = multiplier(j, linear_[j] + alpha * step_linear_[j], problem);
      if (t == 0.) continue;
      at += t * step_linear_[j];
      scale += std::abs(t * step_linear_[j]);
      rise += problem.mu * step_linear_[j] * step_linear_[j];
    }
    if (iteration == 0) first = 1e-10 * scale;
    if (std::abs(at) <= first || (at < 0. && alpha == most)) return alpha;
    (at < 0. ? low : high) = alpha;
    double next = std::min(most, alpha - at / rise);
    if (!(next > low && next < high) && next != most) next = .5 * (low + high);
    if (high - low <= 1e-12 * high) return low > 0. ? low : next;
    alpha = next;
  }
  return alpha;
}

/// Adds alpha s to d.
template <class Algebra>
void SemismoothModel<Algebra>::move(double alpha) {
  d_ += alpha * s_;
  Hd_ += alpha * Hs_;
  for (int j : within_reach_) linear_[j] += alpha * step_linear_[j];
  putOnBounds(d_);
}

/// Whether no entry of d is at a bound.
template <class Algebra>
bool SemismoothModel<Algebra>::isInside() const {
  return (d_ - low_).cwiseMin(high_ - d_).minCoeff() > 0.;
}

/// Moves entries of d that are outside or close to a bound onto the bound.
template <class Algebra>
void SemismoothModel<Algebra>::putOnBounds(Vector& d) const {
  if ((d - low_).cwiseMin(high_ - d).minCoeff() > 2. * kAtBound) return;
  for (int i = 0; i < n_; ++i) {
    if (d[i] < low_[i] + kAtBound) d[i] = low_[i];
    if (d[i] > high_[i] - kAtBound) d[i] = high_[i];
  }
}

/// Adds s and projects to the box. False, without a change, if the value does not decrease enough.
template <class Algebra>
bool SemismoothModel<Algebra>::moveIntoBox(const Problem& problem, double& moved) {
  trial_ = d_ + s_;
  putOnBounds(trial_);
  linearize(trial_, problem, trial_linear_);
  trial_Hd_.setZero();
  algebra_.addHessianProduct(trial_, trial_Hd_);
  if (value(trial_, trial_Hd_, trial_linear_, problem) > value(d_, Hd_, linear_, problem) + 1e-4 * r_.dot(trial_ - d_))
    return false;
  moved = (trial_ - d_).template lpNorm<Eigen::Infinity>();
  d_.swap(trial_);
  linear_.swap(trial_linear_);
  Hd_.swap(trial_Hd_);
  return true;
}

/// Whether the active inequalities at d are those of the factor.
template <class Algebra>
bool SemismoothModel<Algebra>::keepsActiveSet(const Problem& problem) const {
  for (int j : within_reach_) {
    if (!is_equality_[j] && (multiplier(j, linear_[j], problem) > 0.) != bool(factored_active_[j])) return false;
  }
  return true;
}

/// Starts at zero, or at the last minimum if the model is not new and that is better.
template <class Algebra>
void SemismoothModel<Algebra>::begin(const Problem& problem) {
  linear_ = problem.c;
  const bool goes_on = !is_new_ && (d_.array() >= low_.array()).all() && (d_.array() <= high_.array()).all();
  if (is_new_) factored_ = false;
  is_new_ = false;
  if (goes_on) {
    double at_zero = 0.;
    for (int j : within_reach_) {
      const double t = multiplier(j, problem.c[j], problem);
      at_zero += t * t / (2. * problem.mu);
    }
    trial_linear_ = problem.c;
    linearize(d_, problem, trial_linear_);
    if (value(d_, Hd_, trial_linear_, problem) < at_zero) return linear_.swap(trial_linear_);
  }
  trial_linear_ = problem.c;
  d_.setZero();
  Hd_.setZero();
}

/// Computes the gradient r, the active constraints and the fixed variables at d. Returns the largest entry of r for
/// free variables.
template <class Algebra>
double SemismoothModel<Algebra>::findGradient(const Problem& problem) {
  r_ = g_ + problem.damping * d_ + Hd_;
  for (int j : within_reach_) {
    const double t = multiplier(j, linear_[j], problem);
    active_[j] = is_equality_[j] || t > 0.;
    if (t != 0.) algebra_.addRowTo(j, t, r_);
  }
  if (any_fixed_) std::fill(fixed_.begin(), fixed_.end(), false);
  any_fixed_ = false;
  if (isInside()) return r_.template lpNorm<Eigen::Infinity>();
  double remaining = 0.;
  for (int i = 0; i < n_; ++i) {
    fixed_[i] = (d_[i] <= low_[i] && r_[i] >= 0.) || (d_[i] >= high_[i] && r_[i] <= 0.);
    any_fixed_ = any_fixed_ || fixed_[i];
    if (!fixed_[i]) remaining = std::max(remaining, std::abs(r_[i]));
  }
  return remaining;
}

template <class Algebra>
double SemismoothModel<Algebra>::estimateStep(const Problem& problem) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  if (!factored_ || !factored_as_is_ || problem.mu != factored_mu_ || any_fixed_) return unknown;
  algebra_.takeBox(problem.low, problem.high, low_, high_);
  s_ = -g_;
  for (int j = 0; j < int(constraints_.size()); ++j) {
    const double t = multiplier(j, problem.c[j], problem);
    if (!is_equality_[j] && (t > 0.) != bool(factored_active_[j])) return unknown;
    if (t != 0.) algebra_.addRowTo(j, -t, s_);
  }
  algebra_.solve(s_);
  if ((s_ - low_).cwiseMin(high_ - s_).minCoeff() <= 0.) return unknown;
  return s_.template lpNorm<Eigen::Infinity>();
}

template <class Algebra>
const VectorXd& SemismoothModel<Algebra>::minimize(const Problem& problem) {
  algebra_.takeBox(problem.low, problem.high, low_, high_);
  findWithinReach(problem);
  begin(problem);
  double reference = 0.;
  for (int pass = 0; pass < problem.max_passes; ++pass) {
    const double remaining = findGradient(problem);
    if (pass == 0) reference = std::max(remaining, 1e-30);
    if (remaining <= 1e-11 * reference && !(knows_f_ && pass == 0)) break;  // d may be a saddle
    if (!newtonStep(problem)) {
      if (!is_curved_) break;
      omitCurvature();
      Hd_.setZero();
      algebra_.addHessianProduct(d_, Hd_);
      continue;
    }
    const double to_bound = lengthToBound(kLongest);
    double moved = 0.;
    if (to_bound < 1. && moveIntoBox(problem, moved)) {
      if (moved < 1e-10) break;
      continue;
    }
    findChangesAlongStep(problem);
    const double alpha = to_bound >= 1. && isQuadratic() ? 1. : lengthAlong(problem, to_bound);
    move(alpha);
    const bool is_solved = alpha == 1. && !any_fixed_ && keepsActiveSet(problem);
    const bool reaches_bound = alpha == to_bound && to_bound < 1.;  // the next pass follows the bound
    if (is_solved || (alpha * s_.template lpNorm<Eigen::Infinity>() < 1e-10 && !reaches_bound)) break;
  }
  for (int j : out_of_reach_) linear_[j] += algebra_.rowTimes(j, d_);
  for (int i = 0; i < n_; ++i) step_[i] = d_[i];
  return step_;
}

template class SemismoothModel<BandAlgebra>;
template class SemismoothModel<DenseAlgebra<8>>;

}  // namespace kinegraph::inline solvers_internal
