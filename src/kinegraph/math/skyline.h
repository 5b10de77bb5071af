#pragma once

#include <span>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A symmetric positive definite matrix of which each row stores what lies between its first nonzero and the diagonal, and
/// its Cholesky factor in place. Dense, banded and arrow-shaped matrices (band, then a few full rows at the end) are all of
/// this kind, and a factorization costs what the profile costs: linear in the size for a band.
class SkylineMatrix {
 public:
  static constexpr int kPanel = 4;  ///< columns that are factorized together

  /// `first[i]` <= i is the column of the first nonzero in row i of the lower triangle.
  explicit SkylineMatrix(std::vector<int> first = {});

  int size() const { return int(first_.size()); }
  int first(int row) const { return first_[row]; }

  /// Entry (i, j) with first(i) <= j <= i.
  double& at(int i, int j) { return values_[offset_[i] + j]; }
  double at(int i, int j) const { return values_[offset_[i] + j]; }

  void setZero();
  void copyFrom(const SkylineMatrix& other) { values_ = other.values_; }  ///< of equal profile
  void addToDiagonal(double x);

  /// this += w v v^T for a vector that is nonzero in [column, column + width) only.
  void addOuterProduct(const double* v, int column, int width, double w);

  /// this += w (u v^T + v u^T) for u in columns that all lie behind those of v.
  void addCrossProduct(const double* u, int u_column, int u_width, const double* v, int v_column, int v_width, double w);

  /// y += this * x, for a matrix that is not factorized.
  void addProduct(const VectorXd& x, VectorXd& y) const;

  /// Replaces the matrix by its Cholesky factor. False if it is not positive definite. The result is the same on all machines.
  bool factorize();

  /// x <- inverse * x, with the factor.
  void solveInPlace(VectorXd& x) const;

 private:
  /// Consecutive rows that have entries in a panel, or left of it.
  struct Run {
    int row, count;
  };
  bool factorizePanel(int begin, int width, std::span<const Run> runs);
  bool factorizePanels();
  bool factorizeWide();
  bool factorizeSmall();

  std::vector<int> first_;
  std::vector<std::ptrdiff_t> offset_;  ///< of column 0 of a row, were it stored
  std::vector<double> values_;
  std::vector<Run> runs_;               ///< panel by panel
  std::vector<int> first_run_;          ///< of each panel, and the end
  std::vector<double> panel_;           ///< memory for factorize
};

}  // namespace kinegraph
