#include "kinegraph/solvers/local_model.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kAtBound = 1e-14;  ///< an entry of the step this near to a bound is put on it

/// The first column that any row connects each variable to.
std::vector<int> profileOf(const Nlp& nlp, const Jacobian& pattern) {
  std::vector<int> first(nlp.dimension());
  for (int i = 0; i < nlp.dimension(); ++i) first[i] = i;
  bool couples_all = false;
  for (int row = 0; row < pattern.rows(); ++row) {
    couples_all = couples_all || nlp.types()[row] == ObjectiveType::f;
    int leftmost = nlp.dimension();
    for (const Jacobian::Segment& segment : pattern.row_segments(row)) leftmost = std::min(leftmost, segment.column);
    for (const Jacobian::Segment& segment : pattern.row_segments(row)) {
      for (int i = segment.column; i < segment.column + segment.width; ++i) first[i] = std::min(first[i], leftmost);
    }
  }
  if (couples_all) std::fill(first.begin(), first.end(), 0);  // the Hessian of f terms may be full
  return first;
}

}  // namespace

LocalModel::LocalModel(const Nlp& nlp, std::vector<int> costs, std::vector<int> constraints)
    : costs_(std::move(costs)), constraints_(std::move(constraints)) {
  const Jacobian pattern = nlp.makeJacobian();
  H_ = SkylineMatrix(profileOf(nlp, pattern));
  K_ = H_;
  const int n = nlp.dimension(), m = int(constraints_.size());
  for (int row : constraints_) equality_.push_back(nlp.types()[row] == ObjectiveType::eq);
  active_.assign(m, false);
  factored_active_ = active_;
  fixed_.assign(n, false);
  factored_fixed_ = fixed_;
  for (VectorXd* v : {&g_, &d_, &trial_, &r_, &s_, &Hd_}) v->setZero(n);
  linear_.setZero(m);
  trial_linear_.setZero(m);
}

void LocalModel::addRow(SkylineMatrix& matrix, const Jacobian& J, int row, double weight) const {
  const auto segments = J.row_segments(row);
  for (std::size_t a = 0; a < segments.size(); ++a) {
    const double* u = J.values.data() + segments[a].offset;
    matrix.addOuterProduct(u, segments[a].column, segments[a].width, weight);
    for (std::size_t b = 0; b < segments.size(); ++b) {
      if (segments[b].column >= segments[a].column) continue;
      const double* v = J.values.data() + segments[b].offset;
      matrix.addCrossProduct(u, segments[a].column, segments[a].width, v, segments[b].column, segments[b].width, weight);
    }
  }
}

void LocalModel::setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const Jacobian& J) {
  g_.setZero();
  H_.setZero();
  bool has_f = false;
  for (int row : costs_) {
    if (nlp.types()[row] == ObjectiveType::f) {
      J.addRowTo(row, 1., g_);
      has_f = true;
    } else if (nlp.types()[row] == ObjectiveType::sos || phi[row] > 0.) {  // ineqP only where it is violated
      J.addRowTo(row, 2. * phi[row], g_);
      addRow(H_, J, row, 2.);
    }
  }
  if (!has_f) return;
  MatrixXd hessian = MatrixXd::Zero(nlp.dimension(), nlp.dimension());
  if (!nlp.addCostHessian(x, hessian)) return;
  for (int i = 0; i < nlp.dimension(); ++i) {
    for (int j = H_.first(i); j <= i; ++j) H_.at(i, j) += hessian(i, j);
  }
}

void LocalModel::setNoCosts(double weight) {
  g_.setZero();
  H_.setZero();
  H_.addToDiagonal(weight);
}

double LocalModel::largestCurvature() const {
  double largest = 1e-6;
  for (int i = 0; i < H_.size(); ++i) largest = std::max(largest, H_.at(i, i));
  return largest;
}

double LocalModel::multiplier(int j, double value, const Problem& problem) const {
  const double t = problem.lambda[j] + problem.mu * value;
  return equality_[j] ? t : std::max(0., t);
}

void LocalModel::linearize(const VectorXd& d, const Problem& problem, VectorXd& linear) const {
  for (int j = 0; j < int(constraints_.size()); ++j) {
    linear[j] = problem.phi[constraints_[j]] + problem.J.rowTimes(constraints_[j], d);
  }
}

double LocalModel::value(const VectorXd& d, const VectorXd& linear, const Problem& problem) {
  Hd_.setZero();
  H_.addProduct(d, Hd_);
  double sum = g_.dot(d) + .5 * d.dot(Hd_) + .5 * problem.shift * d.squaredNorm();
  for (int j = 0; j < linear.size(); ++j) {
    const double t = multiplier(j, linear[j], problem);
    sum += t * t / (2. * problem.mu);
  }
  return sum;
}

double LocalModel::costChange() const {
  VectorXd Hd = VectorXd::Zero(d_.size());
  H_.addProduct(d_, Hd);
  return g_.dot(d_) + .5 * d_.dot(Hd);
}

/// Factorizes H + shift I + mu J_A^T J_A, with the rows of fixed variables replaced by the identity.
bool LocalModel::factorize(const Problem& problem) {
  double extra = 0., magnitude = 1e-6;  // of the curvatures, which may be negative
  for (int i = 0; i < H_.size(); ++i) magnitude = std::max(magnitude, std::abs(H_.at(i, i)));
  for (int attempt = 0; attempt < 12; ++attempt) {
    K_.copyFrom(H_);
    K_.addToDiagonal(problem.shift + extra);
    for (std::size_t j = 0; j < constraints_.size(); ++j) {
      if (active_[j]) addRow(K_, problem.J, constraints_[j], problem.mu);
    }
    for (int i = 0; i < K_.size(); ++i) {
      for (int j = K_.first(i); j <= i; ++j) {
        if (fixed_[i] || fixed_[j]) K_.at(i, j) = i == j ? 1. : 0.;
      }
    }
    ++factorizations_;
    if (K_.factorize()) return true;
    extra = extra == 0. ? 1e-3 * magnitude : 4. * extra;
  }
  return false;
}

/// s = -K^-1 r among the variables that are free. One that sits at a bound and would be pushed out is fixed as well.
bool LocalModel::newtonStep(const Problem& problem) {
  for (bool pushed_out = true; pushed_out;) {
    if (!factored_ || active_ != factored_active_ || fixed_ != factored_fixed_) {
      factored_ = factorize(problem);
      if (!factored_) return false;
      factored_active_ = active_;
      factored_fixed_ = fixed_;
    }
    const int n = int(s_.size());
    for (int i = 0; i < n; ++i) s_[i] = fixed_[i] ? 0. : -r_[i];
    K_.solveInPlace(s_);
    pushed_out = false;
    for (int i = 0; i < n; ++i) {
      if (fixed_[i] || !((d_[i] <= problem.low[i] && s_[i] < 0.) || (d_[i] >= problem.high[i] && s_[i] > 0.))) continue;
      fixed_[i] = pushed_out = true;
    }
  }
  return true;
}

/// The part of the step s that leads to the first bound, at most 1.
double LocalModel::roomAlong(const Problem& problem) const {
  double room = 1.;
  for (int i = 0; i < s_.size(); ++i) {
    if (s_[i] < 0.) room = std::min(room, (problem.low[i] - d_[i]) / s_[i]);
    if (s_[i] > 0.) room = std::min(room, (problem.high[i] - d_[i]) / s_[i]);
  }
  return room;
}

const VectorXd& LocalModel::minimize(const Problem& problem) {
  const int n = int(d_.size()), m = int(constraints_.size());
  d_.setZero();
  linearize(d_, problem, linear_);
  double current = value(d_, linear_, problem), reference = 0.;
  factored_ = false;
  for (int pass = 0; pass < problem.max_passes; ++pass) {
    r_ = g_ + problem.shift * d_;
    H_.addProduct(d_, r_);
    for (int j = 0; j < m; ++j) {
      const double t = multiplier(j, linear_[j], problem);
      active_[j] = equality_[j] || t > 0.;
      if (t != 0.) problem.J.addRowTo(constraints_[j], t, r_);
    }
    double remaining = 0.;
    for (int i = 0; i < n; ++i) {
      fixed_[i] = (d_[i] <= problem.low[i] && r_[i] >= 0.) || (d_[i] >= problem.high[i] && r_[i] <= 0.);
      if (!fixed_[i]) remaining = std::max(remaining, std::abs(r_[i]));
    }
    if (pass == 0) reference = std::max(remaining, 1e-30);
    if (remaining <= 1e-11 * reference) break;
    if (!newtonStep(problem)) break;
    const double first_hit = roomAlong(problem);
    double alpha = 1., moved = 0.;
    bool accepted = false;
    for (int attempt = 0; attempt < 20 && !accepted; ++attempt) {
      trial_ = (d_ + alpha * s_).cwiseMax(problem.low).cwiseMin(problem.high);
      alpha = attempt == 0 && first_hit < 1. ? first_hit : .5 * alpha;  // cut off at the box first; then without leaving it
      for (int i = 0; i < n; ++i) {
        if (trial_[i] < problem.low[i] + kAtBound) trial_[i] = problem.low[i];
        if (trial_[i] > problem.high[i] - kAtBound) trial_[i] = problem.high[i];
      }
      linearize(trial_, problem, trial_linear_);
      const double next = value(trial_, trial_linear_, problem);
      if (next > current + 1e-4 * r_.dot(trial_ - d_)) continue;
      moved = (trial_ - d_).lpNorm<Eigen::Infinity>();
      d_.swap(trial_);
      linear_.swap(trial_linear_);
      current = next;
      accepted = true;
    }
    if (!accepted || moved < 1e-10) break;
  }
  return d_;
}

}  // namespace kinegraph
