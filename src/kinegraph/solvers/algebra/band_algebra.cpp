#include "kinegraph/solvers/algebra/band_algebra.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "kinegraph/solvers/algebra/band_layout.h"

namespace kinegraph::inline solvers_internal {

BandAlgebra::BandAlgebra(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& constraints, bool full)
    : n_(nlp.dimension()), constraints_(constraints) {
  if (full) {
    place_.resize(std::size_t(n_));
    std::iota(place_.begin(), place_.end(), 0);
    H_linear_ = BandedMatrix(std::vector<int>(std::size_t(n_), n_ - 1));
  } else {
    BandLayout layout = bandLayout(n_, pattern);
    reordered_ = !std::is_sorted(layout.place.begin(), layout.place.end());
    H_linear_ = bandedMatrix(layout, pattern);
    place_ = std::move(layout.place);
  }
  K_ = H_linear_;
  runs_.reserve(std::size_t(n_));
  blocks_.reserve(nlp.curvedRows().size());
  placed_ = placed_sum_ = zeroVector();
}

double BandAlgebra::largestRise(int j, const Vector& low, const Vector& high) const {
  double rise = 0.;
  for (const Jacobian::Segment& segment : J_->row_segments(constraints_[std::size_t(j)])) {
    const double *J = J_->values.data() + segment.offset, *to_low = low.data() + segment.column,
                 *to_high = high.data() + segment.column;
    for (int i = 0; i < segment.width; ++i) {
      if (J[i] != 0.) rise += J[i] * (J[i] > 0. ? to_high[i] : to_low[i]);
    }
  }
  return rise;
}

int BandAlgebra::firstColumn(int j) const {
  if (reordered_ || K_.border() > 0) return 0;
  int first = n_;
  for (const Jacobian::Segment& segment : J_->row_segments(constraints_[std::size_t(j)]))
    first = std::min(first, segment.column);
  return first;
}

/// Adds weight J_row^T J_row to columns from `from` on.
void BandAlgebra::addRow(BandedMatrix& matrix, int row, double weight, int from) {
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
  if (runs_.size() > 1)
    std::sort(runs_.begin(), runs_.end(), [](const Run& a, const Run& b) { return a.place < b.place; });
  for (std::size_t a = 0; a < runs_.size(); ++a) {
    const Run& u = runs_[a];
    matrix.addOuterProduct(u.values, u.place, u.width, weight, from);
    for (std::size_t b = 0; b < a; ++b) {
      matrix.addCrossProduct(u.values, u.place, u.width, runs_[b].values, runs_[b].place, runs_[b].width, weight, from);
    }
  }
}

void BandAlgebra::setLinearCosts(const std::vector<int>& rows) {
  H_linear_.setZero();
  for (int row : rows) addRow(H_linear_, row, 2., 0);
}

void BandAlgebra::addLinearCostGradient(const std::vector<int>& rows, const VectorXd& phi, Vector& g) const {
  for (int row : rows) J_->addRowTo(row, 2. * phi[row], g);
}

void BandAlgebra::copyLinearCosts() {
  H_own_ = H_linear_;
  H_ = &H_own_;
}

void BandAlgebra::setMultipleOfIdentity(double weight) {
  copyLinearCosts();
  H_own_.setZero();
  H_own_.addToDiagonal(weight);
}

double BandAlgebra::largestEntry() const {
  double largest = 0.;
  for (int j = 0; j < n_; ++j) {
    for (int i = j; i < n_; ++i) {
      if (H_->keeps(i, j)) largest = std::max(largest, std::abs(std::as_const(*H_).at(i, j)));
    }
  }
  return largest;
}

void BandAlgebra::addBlocksTo(BandedMatrix& matrix, int from) const {
  for (const Block& block : blocks_) {
    for (int j = 0; j < block.lower->cols(); ++j) {
      for (int i = j; i < block.lower->rows(); ++i) {
        const int a = place_[std::size_t(block.column + i)], b = place_[std::size_t(block.column + j)];
        if (std::min(a, b) >= from) matrix.at(std::max(a, b), std::min(a, b)) += (*block.lower)(i, j);
      }
    }
  }
}

void BandAlgebra::addHessianProduct(const Vector& d, Vector& sum) {
  for (const Block& block : blocks_) {
    const Eigen::Index width = block.lower->rows();
    sum.segment(block.column, width).noalias() +=
        block.lower->selfadjointView<Eigen::Lower>() * d.segment(block.column, width);
  }
  if (!reordered_) return H_->addProduct(d, sum);
  for (Eigen::Index i = 0; i < d.size(); ++i) placed_[place_[i]] = d[i];
  placed_sum_.setZero();
  H_->addProduct(placed_, placed_sum_);
  for (Eigen::Index i = 0; i < d.size(); ++i) sum[i] += placed_sum_[place_[i]];
}

bool BandAlgebra::factorize(double damping, double mu, const std::vector<int>& active, const std::vector<char>& fixed,
                            int first) {
  const int from = BandedMatrix::startBefore(first);
  K_.copyFrom(*H_, from);
  K_.addToDiagonal(damping, from);
  for (int j : active) addRow(K_, constraints_[std::size_t(j)], mu, from);
  addBlocksTo(K_, from);
  for (int i = 0; i < n_; ++i) {
    if (fixed[std::size_t(i)] && place_[i] >= from) K_.isolate(place_[i]);
  }
  return K_.factorize(from);
}

void BandAlgebra::solve(Vector& x) {
  if (!reordered_) return K_.solveInPlace(x);
  for (Eigen::Index i = 0; i < x.size(); ++i) placed_[place_[i]] = x[i];
  K_.solveInPlace(placed_);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = placed_[place_[i]];
}

}  // namespace kinegraph::inline solvers_internal
