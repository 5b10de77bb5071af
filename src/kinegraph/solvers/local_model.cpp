#include "kinegraph/solvers/local_model.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "kinegraph/solvers/band_layout.h"

namespace kinegraph {

namespace {

constexpr int kSmall = 16;          ///< problems up to this size are taken as dense
constexpr double kAtBound = 1e-14;  ///< an entry of the step this near to a bound is put on it
constexpr double kLongest = 4.;     ///< most that a Newton step is lengthened

bool hasRowsOfTypeF(const Nlp& nlp) {
  return std::find(nlp.types().begin(), nlp.types().end(), ObjectiveType::f) != nlp.types().end();
}

BandedMatrix fullMatrix(int n) { return BandedMatrix(std::vector<int>(std::size_t(n), n - 1)); }

}  // namespace

LocalModel::LocalModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs, std::vector<int> constraints)
    : constraints_(std::move(constraints)), has_f_(hasRowsOfTypeF(nlp)) {
  const int n = nlp.dimension(), m = int(constraints_.size());
  if (has_f_ || n <= kSmall) {  // the Hessian of f terms may be full
    place_.resize(n);
    std::iota(place_.begin(), place_.end(), 0);
    H_linear_ = fullMatrix(n);
  } else {
    BandLayout layout = bandLayout(n, pattern);
    reordered_ = !std::is_sorted(layout.place.begin(), layout.place.end());
    H_linear_ = bandedMatrix(layout, pattern);
    place_ = std::move(layout.place);
  }
  K_ = H_linear_;
  linear_costs_.reserve(costs.size());
  is_equality_.reserve(std::size_t(m));
  for (int row : costs) (nlp.types()[row] == ObjectiveType::sos && nlp.isLinear(row) ? linear_costs_ : other_costs_).push_back(row);
  for (int j = 0; j < m; ++j) {
    is_equality_.push_back(nlp.types()[constraints_[j]] == ObjectiveType::eq);
    if (is_equality_[j]) equalities_.push_back(j);
  }
  active_.assign(m, false);
  factored_active_ = active_;
  fixed_.assign(n, false);
  factored_fixed_ = fixed_;
  for (std::vector<int>* list : {&inequalities_, &within_reach_, &out_of_reach_}) list->reserve(std::size_t(m));
  runs_.reserve(std::size_t(n));
  for (VectorXd* v : {&g_, &d_, &trial_, &r_, &s_, &Hd_, &Hs_, &trial_Hd_, &placed_, &placed_sum_}) v->setZero(n);
  linear_.setZero(m);
  trial_linear_.setZero(m);
  step_linear_.setZero(m);
}

/// matrix += weight J_row^T J_row, in columns from `from` on.
void LocalModel::addRow(BandedMatrix& matrix, int row, double weight, int from) {
  runs_.clear();
  for (const Jacobian::Segment& segment : J_->row_segments(row)) {
    const double* values = J_->values.data() + segment.offset;
    for (int start = 0, end; start < segment.width; start = end) {
      const int place = place_[segment.column + start];
      end = reordered_ ? start + 1 : segment.width;
      while (end < segment.width && place_[segment.column + end] == place + end - start) ++end;
      runs_.push_back({values + start, place, end - start});
    }
  }
  if (runs_.size() > 1) std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  for (std::size_t a = 0; a < runs_.size(); ++a) {
    const Run& u = runs_[a];
    matrix.addOuterProduct(u.values, u.place, u.width, weight, from);
    for (std::size_t b = 0; b < a; ++b) {
      matrix.addCrossProduct(u.values, u.place, u.width, runs_[b].values, runs_[b].place, runs_[b].width, weight, from);
    }
  }
}

/// sum += H d
void LocalModel::addHessianProduct(const VectorXd& d, VectorXd& sum) {
  if (!reordered_) {
    H_->addProduct(d, sum);
    return;
  }
  for (Eigen::Index i = 0; i < d.size(); ++i) placed_[place_[i]] = d[i];
  placed_sum_.setZero();
  H_->addProduct(placed_, placed_sum_);
  for (Eigen::Index i = 0; i < d.size(); ++i) sum[i] += placed_sum_[place_[i]];
}

/// x <- K^-1 x, with the factor.
void LocalModel::solve(VectorXd& x) {
  if (!reordered_) {
    K_.solveInPlace(x);
    return;
  }
  for (Eigen::Index i = 0; i < x.size(); ++i) placed_[place_[i]] = x[i];
  K_.solveInPlace(placed_);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = placed_[place_[i]];
}

void LocalModel::setJacobian(const Jacobian& J) {
  J_ = &J;
  is_new_ = true;
  inequalities_.clear();
  for (int j = 0; j < int(constraints_.size()); ++j) {
    if (!is_equality_[j] && !J.zero_row[constraints_[j]]) inequalities_.push_back(j);
  }
}

bool LocalModel::setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature) {
  is_new_ = true;
  if (!knows_linear_costs_) {
    H_linear_.setZero();
    for (int row : linear_costs_) addRow(H_linear_, row, 2.);
    knows_linear_costs_ = true;
  }
  g_.setZero();
  for (int row : linear_costs_) J_->addRowTo(row, 2. * phi[row], g_);
  H_ = &H_linear_;
  if (other_costs_.empty() && !has_f_) return true;
  BandedMatrix& H = ownHessian();
  H.copyFrom(H_linear_);
  for (int row : other_costs_) {
    if (nlp.types()[row] == ObjectiveType::f) {
      J_->addRowTo(row, 1., g_);
    } else if (nlp.types()[row] == ObjectiveType::sos || phi[row] > 0.) {  // ineqP only where it is violated
      J_->addRowTo(row, 2. * phi[row], g_);
      addRow(H, row, 2.);
    }
  }
  if (!has_f_) return true;
  MatrixXd hessian = MatrixXd::Zero(nlp.dimension(), nlp.dimension());
  const bool known = nlp.addCostHessian(x, hessian);
  if (!known && curvature) hessian = *curvature;
  for (int j = 0; j < nlp.dimension(); ++j) {
    for (int i = j; i < nlp.dimension(); ++i) H.at(i, j) += hessian(i, j);
  }
  return known;
}

void LocalModel::setNoCosts(double weight) {
  is_new_ = true;
  g_.setZero();
  BandedMatrix& H = ownHessian();
  H.setZero();
  H.addToDiagonal(weight);
}

/// A Hessian that may be changed.
BandedMatrix& LocalModel::ownHessian() {
  if (H_own_.size() == 0) H_own_ = H_linear_;
  H_ = &H_own_;
  return H_own_;
}

double LocalModel::largestCurvature() const {
  double largest = 1e-6;
  for (int i = 0; i < H_->size(); ++i) largest = std::max(largest, H_->at(i, i));
  return largest;
}

double LocalModel::multiplier(int j, double value, const Problem& problem) const {
  const double t = problem.lambda[j] + problem.mu * value;
  return is_equality_[j] ? t : std::max(0., t);
}

void LocalModel::linearize(const VectorXd& d, const Problem& problem, VectorXd& linear) const {
  for (int j : within_reach_) linear[j] = problem.c[j] + J_->rowTimes(constraints_[j], d);
}

/// An inequality of which the multiplier is zero all over the box does not matter, nor does one that is the same all over it.
void LocalModel::findWithinReach(const Problem& problem) {
  within_reach_.assign(equalities_.begin(), equalities_.end());
  out_of_reach_.clear();
  for (int j : inequalities_) {
    double rise = 0.;  // the most that the row can grow in the box
    for (const Jacobian::Segment& segment : J_->row_segments(constraints_[j])) {
      const double* J = J_->values.data() + segment.offset;
      const double *low = problem.low.data() + segment.column, *high = problem.high.data() + segment.column;
      for (int i = 0; i < segment.width; ++i) {
        if (J[i] != 0.) rise += J[i] * (J[i] > 0. ? high[i] : low[i]);
      }
    }
    if (problem.lambda[j] + problem.mu * (problem.c[j] + rise) > 0.) {
      within_reach_.push_back(j);
    } else {
      out_of_reach_.push_back(j);
      active_[j] = false;
    }
  }
}

double LocalModel::value(const VectorXd& d, const VectorXd& Hd, const VectorXd& linear, const Problem& problem) const {
  double sum = g_.dot(d) + .5 * d.dot(Hd) + .5 * problem.shift * d.squaredNorm();
  for (int j : within_reach_) {
    const double t = multiplier(j, linear[j], problem);
    sum += t * t / (2. * problem.mu);
  }
  return sum;
}

/// Rows out of reach have the multiplier zero before and after, zero rows one that stays.
double LocalModel::decrease(const Problem& problem) const {
  double sum = 0.;
  for (int j : within_reach_) {
    const double before = multiplier(j, problem.c[j], problem), after = multiplier(j, linear_[j], problem);
    sum += (before - after) * (before + after);
  }
  return sum / (2. * problem.mu) - g_.dot(d_) - .5 * d_.dot(Hd_);
}

/// The first column of the factor that the active rows, the fixed variables and the weights change; its size if none is.
int LocalModel::firstChange(const Problem& problem) const {
  if (!factored_ || problem.mu != factored_mu_ || problem.shift != factored_shift_ || fixed_ != factored_fixed_) return 0;
  int first = K_.size();
  for (int j : inequalities_) {
    if (active_[j] == factored_active_[j]) continue;
    if (reordered_ || K_.border() > 0 || !factored_as_is_) return 0;
    for (const Jacobian::Segment& segment : J_->row_segments(constraints_[j])) first = std::min(first, segment.column);
  }
  return first;
}

/// Factorizes H + shift I + mu J_A^T J_A, with the rows of fixed variables replaced by the identity, from column `first` on.
bool LocalModel::factorize(const Problem& problem, int first) {
  double extra = 0.;
  for (int attempt = 0; attempt < 12; ++attempt) {
    const int from = attempt == 0 ? BandedMatrix::startBefore(first) : 0;
    K_.copyFrom(*H_, from);
    K_.addToDiagonal(problem.shift + extra, from);
    for (int j : within_reach_) {
      if (active_[j]) addRow(K_, constraints_[j], problem.mu, from);
    }
    for (int i = 0; i < K_.size(); ++i) {
      if (fixed_[i] && place_[i] >= from) K_.isolate(place_[i]);
    }
    ++factorizations_;
    factored_as_is_ = extra == 0.;
    if (K_.factorize(from)) return true;
    double magnitude = 1e-6;  // of the curvatures, which may be negative
    for (int i = 0; i < H_->size(); ++i) magnitude = std::max(magnitude, std::abs(H_->at(i, i)));
    extra = extra == 0. ? 1e-3 * magnitude : 4. * extra;
  }
  return false;
}

/// s = -K^-1 r among the variables that are free. One that sits at a bound and would be pushed out is fixed as well.
bool LocalModel::newtonStep(const Problem& problem) {
  for (bool pushed_out = true; pushed_out;) {
    if (const int first = firstChange(problem); first < K_.size()) {
      factored_ = factorize(problem, first);
      if (!factored_) return false;
      for (int j : inequalities_) factored_active_[j] = active_[j];
      factored_fixed_ = fixed_;
      factored_mu_ = problem.mu;
      factored_shift_ = problem.shift;
    }
    const int n = int(s_.size());
    for (int i = 0; i < n; ++i) s_[i] = fixed_[i] ? 0. : -r_[i];
    solve(s_);
    pushed_out = false;
    for (int i = 0; i < n; ++i) {
      if (fixed_[i] || !((d_[i] <= problem.low[i] && s_[i] < 0.) || (d_[i] >= problem.high[i] && s_[i] > 0.))) continue;
      fixed_[i] = pushed_out = true;
    }
  }
  return true;
}

/// J s and H s. Where no variable is fixed, K s = -r tells the latter; for small problems, that is not exact enough.
void LocalModel::findChangesAlongStep(const Problem& problem) {
  for (int j : within_reach_) step_linear_[j] = J_->rowTimes(constraints_[j], s_);
  if (s_.size() <= kSmall || !factored_as_is_ || isAnyFixed()) {
    Hs_.setZero();
    return addHessianProduct(s_, Hs_);
  }
  Hs_ = -r_ - problem.shift * s_;
  for (int j : within_reach_) {
    if (active_[j]) J_->addRowTo(constraints_[j], -problem.mu * step_linear_[j], Hs_);
  }
}

/// The part of the step s that leads to the first bound, at most `most`.
double LocalModel::roomAlong(const Problem& problem, double most) const {
  double room = most;
  for (int i = 0; i < s_.size(); ++i) {
    if (s_[i] < 0.) room = std::min(room, (problem.low[i] - d_[i]) / s_[i]);
    if (s_[i] > 0.) room = std::min(room, (problem.high[i] - d_[i]) / s_[i]);
  }
  return room;
}

/// The part of the step s, at most `most`, that leads to the least value: where the slope, which is piecewise linear and grows,
/// is zero. Newton's method finds it in a few steps; halves of the interval make it safe. Exactly 1 if the step is.
double LocalModel::lengthAlong(const Problem& problem, double most) const {
  const double slope = g_.dot(s_) + d_.dot(Hs_) + problem.shift * d_.dot(s_);
  const double curvature = s_.dot(Hs_) + problem.shift * s_.squaredNorm();
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

/// Adds the part alpha of the step s.
void LocalModel::move(const Problem& problem, double alpha) {
  d_ += alpha * s_;
  Hd_ += alpha * Hs_;
  for (int j : within_reach_) linear_[j] += alpha * step_linear_[j];
  putOnBounds(d_, problem);
}

/// Entries that are outside, or next to a bound, go there.
void LocalModel::putOnBounds(VectorXd& d, const Problem& problem) const {
  for (int i = 0; i < d.size(); ++i) {
    if (d[i] < problem.low[i] + kAtBound) d[i] = problem.low[i];
    if (d[i] > problem.high[i] - kAtBound) d[i] = problem.high[i];
  }
}

/// Adds the whole step s and goes back into the box. False, and nothing done, if the value does not fall enough.
bool LocalModel::moveIntoBox(const Problem& problem, double& moved) {
  trial_ = d_ + s_;
  putOnBounds(trial_, problem);
  linearize(trial_, problem, trial_linear_);
  trial_Hd_.setZero();
  addHessianProduct(trial_, trial_Hd_);
  if (value(trial_, trial_Hd_, trial_linear_, problem) > value(d_, Hd_, linear_, problem) + 1e-4 * r_.dot(trial_ - d_)) return false;
  moved = (trial_ - d_).lpNorm<Eigen::Infinity>();
  d_.swap(trial_);
  linear_.swap(trial_linear_);
  Hd_.swap(trial_Hd_);
  return true;
}

/// Are the inequalities that matter at d those of the factor?
bool LocalModel::keepsActiveSet(const Problem& problem) const {
  for (int j : within_reach_) {
    if (!is_equality_[j] && (multiplier(j, linear_[j], problem) > 0.) != bool(factored_active_[j])) return false;
  }
  return true;
}

/// From zero in a new model, else from where it ended the last time if that is better.
void LocalModel::begin(const Problem& problem) {
  linear_ = problem.c;
  const bool goes_on = !is_new_ && (d_.array() >= problem.low.array()).all() && (d_.array() <= problem.high.array()).all();
  if (is_new_) factored_ = false;
  is_new_ = false;
  if (goes_on) {
    double at_zero = 0.;
    for (int j : within_reach_) at_zero += std::pow(multiplier(j, problem.c[j], problem), 2) / (2. * problem.mu);
    trial_linear_ = problem.c;
    linearize(d_, problem, trial_linear_);
    if (value(d_, Hd_, trial_linear_, problem) < at_zero) return linear_.swap(trial_linear_);
  }
  trial_linear_ = problem.c;
  d_.setZero();
  Hd_.setZero();
}

const VectorXd& LocalModel::minimize(const Problem& problem) {
  const int n = int(d_.size());
  findWithinReach(problem);
  begin(problem);
  double reference = 0.;
  for (int pass = 0; pass < problem.max_passes; ++pass) {
    r_ = g_ + problem.shift * d_ + Hd_;
    for (int j : within_reach_) {
      const double t = multiplier(j, linear_[j], problem);
      active_[j] = is_equality_[j] || t > 0.;
      if (t != 0.) J_->addRowTo(constraints_[j], t, r_);
    }
    double remaining = 0.;
    for (int i = 0; i < n; ++i) {
      fixed_[i] = (d_[i] <= problem.low[i] && r_[i] >= 0.) || (d_[i] >= problem.high[i] && r_[i] <= 0.);
      if (!fixed_[i]) remaining = std::max(remaining, std::abs(r_[i]));
    }
    if (pass == 0) reference = std::max(remaining, 1e-30);
    if (remaining <= 1e-11 * reference) break;
    if (!newtonStep(problem)) break;
    const double room = roomAlong(problem, kLongest);
    double moved = 0.;
    if (room < 1. && moveIntoBox(problem, moved)) {
      if (moved < 1e-10) break;
      continue;
    }
    findChangesAlongStep(problem);
    const double alpha = lengthAlong(problem, room);
    move(problem, alpha);
    const bool is_solved = alpha == 1. && !isAnyFixed() && keepsActiveSet(problem);
    const bool reaches_bound = alpha == room && room < 1.;  // the next pass goes along it
    if (is_solved || (alpha * s_.lpNorm<Eigen::Infinity>() < 1e-10 && !reaches_bound)) break;
  }
  for (int j : out_of_reach_) linear_[j] += J_->rowTimes(constraints_[j], d_);
  return d_;
}

}  // namespace kinegraph
