#include "kinegraph/solvers/local_model.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kAtBound = 1e-14;  ///< an entry of the step this near to a bound is put on it

bool hasRowsOfTypeF(const Nlp& nlp) {
  return std::find(nlp.types().begin(), nlp.types().end(), ObjectiveType::f) != nlp.types().end();
}

/// Where each variable goes. Variables that rows connect to others much farther on than is usual (dofs that many slices of a
/// path share) go to the end: the matrix is then a band with a border, and its factor has no other entries.
std::vector<int> placesOf(int n, const Jacobian& pattern) {
  std::vector<int> reach(n, 0), place(n);
  for (int row = 0; row < pattern.rows(); ++row) {
    const auto segments = pattern.row_segments(row);
    int last = 0;
    for (const Jacobian::Segment& segment : segments) last = std::max(last, segment.column + segment.width - 1);
    for (const Jacobian::Segment& segment : segments) {
      for (int i = segment.column; i < segment.column + segment.width; ++i) reach[i] = std::max(reach[i], last - i);
    }
  }
  std::vector<int> sorted = reach;
  std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
  const int usual = n > 0 ? 4 * sorted[n / 2] + 16 : 0;
  int next = 0;
  for (int i = 0; i < n; ++i) {
    if (reach[i] <= usual) place[i] = next++;
  }
  for (int i = 0; i < n; ++i) {
    if (reach[i] > usual) place[i] = next++;
  }
  return place;
}

/// The first place that any row connects each place to.
std::vector<int> profileOf(const Jacobian& pattern, const std::vector<int>& place, bool couples_all) {
  const int n = int(place.size());
  std::vector<int> first(n);
  for (int i = 0; i < n; ++i) first[i] = couples_all ? 0 : i;
  for (int row = 0; row < pattern.rows(); ++row) {
    int leftmost = n;
    for (const Jacobian::Segment& segment : pattern.row_segments(row)) {
      for (int i = segment.column; i < segment.column + segment.width; ++i) leftmost = std::min(leftmost, place[i]);
    }
    for (const Jacobian::Segment& segment : pattern.row_segments(row)) {
      for (int i = segment.column; i < segment.column + segment.width; ++i) first[place[i]] = std::min(first[place[i]], leftmost);
    }
  }
  return first;
}

}  // namespace

LocalModel::LocalModel(const Nlp& nlp, std::vector<int> costs, std::vector<int> constraints)
    : costs_(std::move(costs)), constraints_(std::move(constraints)) {
  const Jacobian pattern = nlp.makeJacobian();
  const int n = nlp.dimension(), m = int(constraints_.size());
  const bool couples_all = hasRowsOfTypeF(nlp);  // their Hessian may be full
  place_.resize(n);
  for (int i = 0; i < n; ++i) place_[i] = i;
  if (!couples_all) {
    std::vector<int> places = placesOf(n, pattern);
    reordered_ = places != place_;
    place_ = std::move(places);
  }
  H_ = SkylineMatrix(profileOf(pattern, place_, couples_all));
  K_ = H_;
  for (int row : constraints_) equality_.push_back(nlp.types()[row] == ObjectiveType::eq);
  active_.assign(m, false);
  factored_active_ = active_;
  fixed_.assign(n, false);
  factored_fixed_ = fixed_place_ = fixed_;
  within_reach_.reserve(std::size_t(m));
  out_of_reach_.reserve(std::size_t(m));
  for (VectorXd* v : {&g_, &d_, &trial_, &r_, &s_, &Hd_, &trial_Hd_, &placed_, &placed_sum_}) v->setZero(n);
  linear_.setZero(m);
  trial_linear_.setZero(m);
}

void LocalModel::addRow(SkylineMatrix& matrix, const Jacobian& J, int row, double weight) {
  runs_.clear();
  for (const Jacobian::Segment& segment : J.row_segments(row)) {
    const double* values = J.values.data() + segment.offset;
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
    matrix.addOuterProduct(u.values, u.place, u.width, weight);
    for (std::size_t b = 0; b < a; ++b) {
      matrix.addCrossProduct(u.values, u.place, u.width, runs_[b].values, runs_[b].place, runs_[b].width, weight);
    }
  }
}

/// sum += H d
void LocalModel::addHessianProduct(const VectorXd& d, VectorXd& sum) {
  if (!reordered_) {
    H_.addProduct(d, sum);
    return;
  }
  for (Eigen::Index i = 0; i < d.size(); ++i) placed_[place_[i]] = d[i];
  placed_sum_.setZero();
  H_.addProduct(placed_, placed_sum_);
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

bool LocalModel::setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const Jacobian& J, const MatrixXd* curvature) {
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
  if (!has_f) return true;
  MatrixXd hessian = MatrixXd::Zero(nlp.dimension(), nlp.dimension());
  const bool known = nlp.addCostHessian(x, hessian);
  if (!known && curvature) hessian = *curvature;
  for (int i = 0; i < nlp.dimension(); ++i) {
    for (int j = H_.first(i); j <= i; ++j) H_.at(i, j) += hessian(i, j);
  }
  return known;
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
  for (int j : within_reach_) linear[j] = problem.phi[constraints_[j]] + problem.J.rowTimes(constraints_[j], d);
}

/// An inequality of which the multiplier is zero all over the box does not matter.
void LocalModel::findWithinReach(const Problem& problem) {
  within_reach_.clear();
  out_of_reach_.clear();
  for (int j = 0; j < int(constraints_.size()); ++j) {
    const double c = problem.phi[constraints_[j]];
    linear_[j] = trial_linear_[j] = c;
    if (equality_[j]) {
      within_reach_.push_back(j);
      continue;
    }
    double rise = 0.;  // the most that the row can grow in the box
    bool depends = false;
    for (const Jacobian::Segment& segment : problem.J.row_segments(constraints_[j])) {
      const double* J = problem.J.values.data() + segment.offset;
      int nonzero = 0;
      for (int i = 0; i < segment.width; ++i) nonzero |= J[i] != 0.;
      if (!nonzero) continue;
      depends = true;
      const double *low = problem.low.data() + segment.column, *high = problem.high.data() + segment.column;
      for (int i = 0; i < segment.width; ++i) {
        if (J[i] != 0.) rise += J[i] * (J[i] > 0. ? high[i] : low[i]);
      }
    }
    if (problem.lambda[j] + problem.mu * (c + rise) > 0.) {
      within_reach_.push_back(j);
    } else {
      active_[j] = false;
      if (depends) out_of_reach_.push_back(j);
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

double LocalModel::costChange() const { return g_.dot(d_) + .5 * d_.dot(Hd_); }

/// Factorizes H + shift I + mu J_A^T J_A, with the rows of fixed variables replaced by the identity.
bool LocalModel::factorize(const Problem& problem) {
  double extra = 0., magnitude = 1e-6;  // of the curvatures, which may be negative
  for (int i = 0; i < H_.size(); ++i) magnitude = std::max(magnitude, std::abs(H_.at(i, i)));
  for (int attempt = 0; attempt < 12; ++attempt) {
    K_.copyFrom(H_);
    K_.addToDiagonal(problem.shift + extra);
    for (int j : within_reach_) {
      if (active_[j]) addRow(K_, problem.J, constraints_[j], problem.mu);
    }
    const bool some_fixed = std::find(fixed_.begin(), fixed_.end(), true) != fixed_.end();
    for (int i = 0; i < K_.size(); ++i) fixed_place_[place_[i]] = fixed_[i];
    for (int i = 0; some_fixed && i < K_.size(); ++i) {
      for (int j = K_.first(i); j <= i; ++j) {
        if (fixed_place_[i] || fixed_place_[j]) K_.at(i, j) = i == j ? 1. : 0.;
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
    solve(s_);
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
  const int n = int(d_.size());
  d_.setZero();
  Hd_.setZero();
  findWithinReach(problem);
  double current = value(d_, Hd_, linear_, problem), reference = 0.;
  factored_ = false;
  for (int pass = 0; pass < problem.max_passes; ++pass) {
    r_ = g_ + problem.shift * d_ + Hd_;
    for (int j : within_reach_) {
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
    bool accepted = false, reaches_bound = false;
    for (int attempt = 0; attempt < 20 && !accepted; ++attempt) {
      trial_ = (d_ + alpha * s_).cwiseMax(problem.low).cwiseMin(problem.high);
      alpha = attempt == 0 && first_hit < 1. ? first_hit : .5 * alpha;  // cut off at the box first; then without leaving it
      for (int i = 0; i < n; ++i) {
        if (trial_[i] < problem.low[i] + kAtBound) trial_[i] = problem.low[i];
        if (trial_[i] > problem.high[i] - kAtBound) trial_[i] = problem.high[i];
      }
      linearize(trial_, problem, trial_linear_);
      trial_Hd_.setZero();
      addHessianProduct(trial_, trial_Hd_);
      const double next = value(trial_, trial_Hd_, trial_linear_, problem);
      if (next > current + 1e-4 * r_.dot(trial_ - d_)) continue;
      moved = (trial_ - d_).lpNorm<Eigen::Infinity>();
      d_.swap(trial_);
      linear_.swap(trial_linear_);
      Hd_.swap(trial_Hd_);
      current = next;
      accepted = true;
      reaches_bound = attempt == 1 && first_hit < 1.;
    }
    if (!accepted || (moved < 1e-10 && !reaches_bound)) break;  // where a bound is near, the next pass goes along it
  }
  for (int j : out_of_reach_) linear_[j] += problem.J.rowTimes(constraints_[j], d_);
  return d_;
}

}  // namespace kinegraph
