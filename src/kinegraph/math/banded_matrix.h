#pragma once

#include <array>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A symmetric positive definite matrix with a band around the diagonal and full rows at the end, and its factor L D
/// L^T in place: that of a path, with variables that all slices share last. Dense matrices are those whose band is as
/// wide as they are. Columns of the lower triangle lie one behind the other; a factorization costs what the band costs,
/// linear in the size.
class BandedMatrix {
 public:
  /// The band of column j ends in row `last[j]` >= j, or where that of a column to its left ends if that is below; then
  /// come `border` full rows and columns.
  explicit BandedMatrix(std::vector<int> last = {}, int border = 0);

  int size() const { return int(offset_.size()); }
  int border() const { return size() - band_; }

  /// Is entry (i, j) with i >= j kept? The others are zero.
  bool keeps(int i, int j) const { return i >= band_ || i <= last_[j]; }

  /// Entry (i, j) with i >= j that is kept.
  double& at(int i, int j) { return values_[place(i, j)]; }
  double at(int i, int j) const { return values_[place(i, j)]; }

  void setZero();

  /// Takes the columns of another one of equal form, those from `first` on.
  void copyFrom(const BandedMatrix& other, int first = 0);
  void addToDiagonal(double x, int first = 0);

  /// Makes row and column i those of the identity.
  void isolate(int i);

  /// this += w v v^T for a vector that is nonzero in [first, first + width) only, in columns from `from` on.
  void addOuterProduct(const double* v, int first, int width, double w, int from = 0);

  /// this += w (u v^T + v u^T) for u in rows that all lie behind those of v.
  void addCrossProduct(const double* u, int u_first, int u_width, const double* v, int v_first, int v_width, double w,
                       int from = 0);

  /// y += this * x, for a matrix that is not factorized.
  void addProduct(const VectorXd& x, VectorXd& y);

  /// Replaces the matrix by its factor L D L^T, as L D. False if it is not positive definite. The result is the same on
  /// all machines. Where it has no border and just columns from `first` on hold the matrix, while those before are its
  /// factor already, it begins there. `first` comes from startBefore.
  bool factorize(int first = 0);

  /// The last column, at or before this one, where a factorization can begin.
  static int startBefore(int column) { return column - column % kPanel; }

  /// x <- inverse * x, with the factor.
  void solveInPlace(VectorXd& x);

 private:
  static constexpr int kPanel = 4;  ///< columns
  static constexpr int kPadding =
      kPanel - 1;  ///< zeros behind each part of a column, so that whole packs can be read and written

  struct Offset {
    std::ptrdiff_t band, border;  ///< of row 0, were it stored, in either part
  };
  std::ptrdiff_t place(int i, int j) const { return (i < band_ ? offset_[j].band : offset_[j].border) + i; }
  /// Columns that are factorized together: pointers to row 0 of each, were it stored, next to the diagonal and in the
  /// border.
  struct Panel {
    int begin, width;
    int end;  ///< of the rows next to the diagonal
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
  std::vector<int> last_;       ///< per column of the band; the same in each panel
  std::vector<Offset> offset_;  ///< per column
  std::vector<double> values_;
  std::vector<double> inverse_;  ///< of D
  std::vector<double> x_, y_;    ///< vectors with the padding that columns have
};

}  // namespace kinegraph
