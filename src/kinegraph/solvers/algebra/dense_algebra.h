#pragma once

#include <cmath>
#include <cstring>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline solvers_internal {

/// The linear algebra of a SemismoothModel of at most N variables (see BandAlgebra): vectors and matrices have the
/// fixed size N. Padding entries are zero in vectors and rows, and those of the identity in H and K.
template <int N>
class DenseAlgebra {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  DenseAlgebra(const Nlp& nlp, const Jacobian&, const std::vector<int>& constraints, bool)
      : n_(nlp.dimension()), constraints_(constraints), rows_(N, Eigen::Index(constraints.size())) {
    rows_.setZero();
  }

  static constexpr int size() { return N; }
  static Vector zeroVector() { return Vector::Zero(); }

  void takeBox(const VectorXd& low, const VectorXd& high, Vector& to_low, Vector& to_high) const {
    to_low.setConstant(-1.);
    to_high.setConstant(1.);
    for (int i = 0; i < n_; ++i) to_low[i] = low[i], to_high[i] = high[i];
  }

  void setJacobian(const Jacobian& J) {
    J_ = &J;
    for (std::size_t j = 0; j < constraints_.size(); ++j) {
      auto row = rows_.col(Eigen::Index(j));
      if (J.zero_row[std::size_t(constraints_[j])]) {
        row.setZero();
      } else {
        takeRow(constraints_[j], row);
      }
    }
  }
  double rowTimes(int j, const Vector& d) const { return rows_.col(j).dot(d); }
  void addRowTo(int j, double factor, Vector& x) const { x += factor * rows_.col(j); }
  double largestRise(int j, const Vector& low, const Vector& high) const {
    double rise = 0.;
    for (int i = 0; i < n_; ++i) {
      if (const double slope = rows_(i, j); slope != 0.) rise += slope * (slope > 0. ? high[i] : low[i]);
    }
    return rise;
  }
  int firstColumn(int) const { return 0; }

  void setLinearCosts(const std::vector<int>& rows) {
    cost_rows_.setZero(N, Eigen::Index(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) takeRow(rows[k], cost_rows_.col(Eigen::Index(k)));
    identityOutside(H_linear_);
    for (Eigen::Index k = 0; k < cost_rows_.cols(); ++k) addProduct(H_linear_, cost_rows_.col(k), 2.);
  }
  void addLinearCostGradient(const std::vector<int>& rows, const VectorXd& phi, Vector& g) const {
    Vector sum = g;  // in registers
    for (std::size_t k = 0; k < rows.size(); ++k) sum += (2. * phi[rows[k]]) * cost_rows_.col(Eigen::Index(k));
    g = sum;
  }
  void useLinearCosts() { H_ = &H_linear_; }
  void copyLinearCosts() {
    H_own_ = H_linear_;
    H_ = &H_own_;
  }
  void setMultipleOfIdentity(double weight) {
    identityOutside(H_own_);
    for (int i = 0; i < n_; ++i) H_own_(i, i) = weight;
    H_ = &H_own_;
  }
  void addCost(int row, double weight) {
    Vector v = zeroVector();
    takeRow(row, v);
    addProduct(*H_, v, weight);
  }
  void addEntry(int i, int j, double value) {
    (*H_)(i, j) += value;
    if (i != j) (*H_)(j, i) += value;
  }
  void addCostGradient(int row, double factor, Vector& g) const {
    for (const Jacobian::Segment& segment : J_->row_segments(row)) {
      for (int i = 0; i < segment.width; ++i)
        g[segment.column + i] += factor * J_->values[std::size_t(segment.offset + i)];
    }
  }
  double largestEntry() const { return H_->topLeftCorner(n_, n_).cwiseAbs().maxCoeff(); }
  double diagonal(int i) const { return i < n_ ? (*H_)(i, i) : 0.; }
  void addHessianProduct(const Vector& d, Vector& sum) const { sum.noalias() += H_->lazyProduct(d); }

  template <class AddTo>
  void addBlock(int column, const MatrixXd& room, const AddTo& addTo) {
    if (H_ != &H_curved_) {
      before_blocks_ = H_;
      H_curved_ = *H_;
      H_ = &H_curved_;
    }
    addTo(H_curved_.block(column, column, room.rows(), room.cols()));
    for (int j = 0; j < N; ++j) {
      for (int i = j + 1; i < N; ++i) H_curved_(j, i) = H_curved_(i, j);
    }
  }
  void dropBlocks() {
    if (H_ == &H_curved_) H_ = before_blocks_;
  }

  bool factorize(double damping, double mu, const std::vector<int>& active, const std::vector<char>& fixed, int) {
    K_ = *H_;
    K_.diagonal().array() += damping;
    for (int j : active) addSquare(rows_.col(j), mu);
    for (int i = 0; i < n_; ++i) {
      if (!fixed[std::size_t(i)]) continue;
      K_.row(i).setZero();
      K_.col(i).setZero();
      K_(i, i) = 1.;
    }
#pragma GCC unroll 16
    for (int j = 0; j < N; ++j) {  // L D L^T; columns hold L D below the diagonal
      if (!(K_(j, j) > 0.) || !std::isfinite(K_(j, j))) return false;
      inverse_[j] = 1. / K_(j, j);
#pragma GCC unroll 16
      for (int k = j + 1; k < N; ++k) {
        const double factor = K_(k, j) * inverse_[j];
#pragma GCC unroll 16
        for (int p = k - k % 2; p < N; p += 2) K_.template block<2, 1>(p, k) -= factor * K_.template block<2, 1>(p, j);
      }
    }
    return true;
  }

  void solve(Vector& x) const {
#pragma GCC unroll 16
    for (int j = 0; j < N; ++j) {
      x[j] *= inverse_[j];
#pragma GCC unroll 16
      for (int i = j + 1; i < N; ++i) x[i] -= x[j] * K_(i, j);
    }
#pragma GCC unroll 16
    for (int j = N - 1; j >= 0; --j) {
      double sum = 0.;
#pragma GCC unroll 16
      for (int i = j + 1; i < N; ++i) sum += K_(i, j) * x[i];
      x[j] -= inverse_[j] * sum;
    }
  }

 private:
  using Matrix = Eigen::Matrix<double, N, N>;

  template <class Column>
  void takeRow(int row, Column&& to) const {
    for (const Jacobian::Segment& segment : J_->row_segments(row)) {
      std::memcpy(to.data() + segment.column, J_->values.data() + segment.offset,
                  std::size_t(segment.width) * sizeof(double));
    }
  }
  void identityOutside(Matrix& matrix) const {
    matrix.setZero();
    for (int i = n_; i < N; ++i) matrix(i, i) = 1.;
  }
  /// K += weight v v^T on and below the diagonal.
  template <class Column>
  void addSquare(const Column& given, double weight) {
    const Vector v = given;
#pragma GCC unroll 16
    for (int k = 0; k < N; ++k) {
      const double factor = weight * v[k];
#pragma GCC unroll 16
      for (int p = k - k % 2; p < N; p += 2) K_.template block<2, 1>(p, k) += factor * v.template segment<2>(p);
    }
  }
  /// matrix += weight v v^T, both triangles.
  template <class Column>
  static void addProduct(Matrix& matrix, const Column& v, double weight) {
    for (int k = 0; k < N; ++k) matrix.col(k) += (weight * v[k]) * v;
  }

  int n_;
  const Jacobian* J_ = nullptr;
  const std::vector<int>& constraints_;
  Eigen::Matrix<double, N, Eigen::Dynamic> rows_, cost_rows_;  ///< of J: constraints, linear costs
  Matrix H_linear_, H_own_, H_curved_, K_;                     ///< both triangles, except for K
  Matrix *H_ = &H_linear_, *before_blocks_ = &H_linear_;
  Vector inverse_;  ///< of D
};

}  // namespace kinegraph::inline solvers_internal
