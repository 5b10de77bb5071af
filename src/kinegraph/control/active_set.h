#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinegraph {

/// A strictly convex quadratic program: minimize x' H x / 2 + g' x subject to rows a x >= b, by a dual active-set method.
///
/// From the free minimum, the row that is missed by most is added until none is missed; the answer is exact. Memory is
/// requested where a program is larger than all before it. Source: Goldfarb, Idnani, A numerically stable dual method for
/// solving strictly convex quadratic programs, 1983.
class ActiveSet {
 public:
  /// For `size` unknowns and up to `rows` rows.
  void resize(int size, int rows);

  /// Starts a new program without rows.
  void clear() { rows_ = 0; }
  Eigen::Ref<Eigen::MatrixXd> hessian() { return hessian_; }
  Eigen::Ref<Eigen::VectorXd> gradient() { return gradient_; }

  /// Adds a row; returns its number. Of `a` there are as many entries as unknowns.
  template <class Derived>
  int addRow(const Eigen::MatrixBase<Derived>& a, double b) {
    normals_.col(rows_) = a;
    bounds_[rows_] = b;
    return rows_++;
  }
  int rows() const { return rows_; }

  /// False if the rows contradict each other. `hessian` is overwritten.
  bool solve();

  const Eigen::VectorXd& x() const { return x_; }
  int activeCount() const { return active_count_; }
  int active(int i) const { return active_[std::size_t(i)]; }  ///< number of a row that holds with equality
  double multiplier(int i) const { return multipliers_[i]; }   ///< >= 0

 private:
  void addActive(int row);
  void dropActive(int place);
  int mostMissed() const;
  bool enter(int row);

  int size_ = 0, rows_ = 0, active_count_ = 0;
  Eigen::MatrixXd hessian_, factor_, basis_, triangle_, normals_;  ///< basis: L^-T Q, triangle: R of L^-1 N = Q R
  Eigen::VectorXd gradient_, bounds_, x_, step_, turned_, change_, multipliers_;
  std::vector<int> active_;
  std::vector<char> is_active_;
};

}  // namespace kinegraph
