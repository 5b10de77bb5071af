#pragma once

#include <array>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline math_internal {

/// A symmetric positive definite matrix with a band around the diagonal and a border of full rows, and its factor L D
/// L^T in place. Problems of paths have this form; the border holds variables that all slices share. A dense matrix has
/// a band of full width. The columns of the lower triangle are contiguous. For a fixed width of the band, the cost of a
/// factorization is linear in the size.
class BandedMatrix {
 public:
  /// The band of column j ends in row `last[j]` >= j, or at the end of the band of a column to its left, if that is
  /// below. `border` full rows and columns follow.
  explicit BandedMatrix(std::vector<int> last = {}, int border = 0);

  int size() const { return int(offset_.size()); }
  int border() const { return size() - band_; }

  /// Whether entry (i, j) with i >= j is stored. All others are zero.
  bool keeps(int i, int j) const { return i >= band_ || i <= last_[j]; }

  /// Returns a stored entry (i, j) with i >= j.
  double& at(int i, int j) { return values_[place(i, j)]; }
  double at(int i, int j) const { return values_[place(i, j)]; }

  void setZero();

  /// Copies the columns from `first` on of a matrix of equal form.
  void copyFrom(const BandedMatrix& other, int first = 0);
  void addToDiagonal(double x, int first = 0);

  /// Sets row and column i to those of the identity.
  void isolate(int i);

  /// Adds w v v^T to columns from `from` on, for a vector v with nonzeros in [first, first + width).
  void addOuterProduct(const double* v, int first, int width, double w, int from = 0);

  /// Adds w (u v^T + v u^T), for u with nonzeros after those of v.
  void addCrossProduct(const double* u, int u_first, int u_width, const double* v, int v_first, int v_width, double w,
                       int from = 0);

  /// Adds this * x to y, before the factorization.
  void addProduct(const VectorXd& x, VectorXd& y);

  /// Replaces the matrix by its factor L D L^T, as L D. False if it is not positive definite. The result is equal on
  /// all machines. Without a border, the factorization may start at column `first` (see startBefore), if the columns
  /// before hold the factor already.
  bool factorize(int first = 0);

  /// Returns the last possible start of a factorization at or before a column.
  static int startBefore(int column) { return column - column % kPanel; }

  /// Solves this * y = x with the factor, and stores y in x.
  void solveInPlace(VectorXd& x);

 private:
  static constexpr int kPanel = 4;             ///< columns
  static constexpr int kPadding = kPanel - 1;  ///< zeros after each part of a column, for access by whole packs

  struct Offset {
    std::ptrdiff_t band, border;  ///< offsets of row 0, stored or not, in both parts
  };
  std::ptrdiff_t place(int i, int j) const { return (i < band_ ? offset_[j].band : offset_[j].border) + i; }
  /// Columns that are factorized together: pointers to row 0 of each, stored or not, in the band and in the
  /// border.
  struct Panel {
    int begin, width;
    int end;  ///< end of the rows of the band
    bool has_border;
    std::array<const double*, kPanel> columns, borders;
  };
  Panel panelAt(int begin) const;
  bool factorizePanel(int begin);
  void takeProducts(const Panel& panel, int first);
  bool factorizeAll(int first);
  bool factorizeWide(int first);
  void product();
  void productWide();
  void solve();
  void solveWide();

  int band_ = 0;                ///< rows before the border
  std::vector<int> last_;       ///< per column of the band; equal within each panel
  std::vector<Offset> offset_;  ///< per column
  std::vector<double> values_;
  std::vector<double> inverse_;  ///< of D
  std::vector<double> x_, y_;    ///< vectors with the padding of columns
};

}  // namespace kinegraph::inline math_internal
