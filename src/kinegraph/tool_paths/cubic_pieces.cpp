#include "kinegraph/tool_paths/plan_tool_path.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

/// Second derivatives (d, K) at the knots of the spline with not-a-knot ends, K >= 4. The two end conditions are
/// eliminated, which leaves a tridiagonal system.
MatrixXd secondDerivatives(const std::vector<double>& s, const MatrixXd& y) {
  const Eigen::Index n = y.cols() - 2;
  MatrixXd right(y.rows(), n), second(y.rows(), n + 2);
  VectorXd h(n + 1), diagonal(n), upper(n), lower(n);
  for (Eigen::Index k = 0; k <= n; ++k) h[k] = s[std::size_t(k) + 1] - s[std::size_t(k)];
  for (Eigen::Index k = 0; k < n; ++k) {
    lower[k] = h[k], diagonal[k] = 2. * (h[k] + h[k + 1]), upper[k] = h[k + 1];
    right.col(k) = 6. * ((y.col(k + 2) - y.col(k + 1)) / h[k + 1] - (y.col(k + 1) - y.col(k)) / h[k]);
  }
  const double first = h[0] / h[1], last = h[n] / h[n - 1];
  diagonal[0] += lower[0] * (1. + first), upper[0] -= lower[0] * first;
  diagonal[n - 1] += upper[n - 1] * (1. + last), lower[n - 1] -= upper[n - 1] * last;
  for (Eigen::Index k = 1; k < n; ++k) {
    const double factor = lower[k] / diagonal[k - 1];
    diagonal[k] -= factor * upper[k - 1];
    right.col(k) -= factor * right.col(k - 1);
  }
  second.col(n) = right.col(n - 1) / diagonal[n - 1];
  for (Eigen::Index k = n - 1; k > 0; --k)
    second.col(k) = (right.col(k - 1) - upper[k - 1] * second.col(k + 1)) / diagonal[k - 1];
  second.col(0) = (1. + first) * second.col(1) - first * second.col(2);
  second.col(n + 1) = (1. + last) * second.col(n) - last * second.col(n - 1);
  return second;
}

/// Throws unless the curve has the piece.
void checkPiece(const CubicPieces& curve, int piece) {
  if (piece < 0 || piece >= curve.pieces() || curve.coefficient.size() != curve.begin.size())
    throw ValueError(cat("Trajectory: there is no piece ", piece, "; the curve has ", curve.pieces(), " pieces and ",
                         curve.coefficient.size(), " coefficient matrices"));
}

}  // namespace

int CubicPieces::pieceAt(double s) const {
  const auto after = std::upper_bound(begin.begin(), begin.end(), s);
  return std::max(0, int(after - begin.begin()) - 1);
}

CubicPieces::Range CubicPieces::range(int piece) const {
  checkPiece(*this, piece);
  const double from = begin[std::size_t(piece)], h = end(piece) - from;
  const MatrixXd& c = coefficient[std::size_t(piece)];
  const VectorXd last = eval(piece, end(piece));
  Range range{c.col(0).cwiseMin(last), c.col(0).cwiseMax(last)};
  for (Eigen::Index row = 0; row < c.rows(); ++row) {
    // Zeros of the derivative d + 2 b x + 3 a x^2, without cancellation.
    const double d = c(row, 1), b = c(row, 2), a = 3. * c(row, 3), square = b * b - a * d;
    if (square < 0.) continue;
    const double sum = -b - std::copysign(std::sqrt(square), b);
    for (const double x : {sum / a, d / sum}) {
      if (!(x > 0. && x < h)) continue;
      const double y = c(row, 0) + x * (c(row, 1) + x * (c(row, 2) + x * c(row, 3)));
      range.least[row] = std::min(range.least[row], y);
      range.largest[row] = std::max(range.largest[row], y);
    }
  }
  return range;
}

VectorXd CubicPieces::eval(int piece, double s, int order) const {
  checkPiece(*this, piece);
  const double x = s - begin[std::size_t(piece)];
  const MatrixXd& c = coefficient[std::size_t(piece)];
  switch (order) {
    case 0:
      return c.col(0) + x * (c.col(1) + x * (c.col(2) + x * c.col(3)));
    case 1:
      return c.col(1) + x * (2. * c.col(2) + 3. * x * c.col(3));
    case 2:
      return 2. * c.col(2) + 6. * x * c.col(3);
    default:
      return 6. * c.col(3);
  }
}

void CubicPieces::addPiece(double from, double to, const MatrixXd& coefficients, bool corner) {
  begin.push_back(from);
  coefficient.push_back(coefficients);
  is_corner.push_back(corner);
  length = to;
}

void CubicPieces::addSpline(const std::vector<double>& s, const MatrixXd& y, bool corner) {
  const Eigen::Index count = y.cols();
  MatrixXd second = MatrixXd::Zero(y.rows(), count);
  if (count == 3) {
    const double a = s[1] - s[0], b = s[2] - s[1];
    const VectorXd bend = 2. * ((y.col(2) - y.col(1)) / b - (y.col(1) - y.col(0)) / a) / (a + b);
    second.colwise() = bend;
  } else if (count > 3) {
    second = secondDerivatives(s, y);
  }
  MatrixXd c(y.rows(), 4);
  for (Eigen::Index k = 0; k + 1 < count; ++k) {
    const double h = s[std::size_t(k) + 1] - s[std::size_t(k)];
    c.col(0) = y.col(k);
    c.col(1) = (y.col(k + 1) - y.col(k)) / h - h / 6. * (2. * second.col(k) + second.col(k + 1));
    c.col(2) = .5 * second.col(k);
    c.col(3) = (second.col(k + 1) - second.col(k)) / (6. * h);
    addPiece(s[std::size_t(k)], s[std::size_t(k) + 1], c, k == 0 && corner);
  }
}

void CubicPieces::addHermite(const std::vector<double>& s, const MatrixXd& y, const MatrixXd& slope, bool corner) {
  MatrixXd c(y.rows(), 4);
  for (Eigen::Index k = 0; k + 1 < y.cols(); ++k) {
    const double h = s[std::size_t(k) + 1] - s[std::size_t(k)];
    const VectorXd chord = (y.col(k + 1) - y.col(k)) / h;
    c.col(0) = y.col(k);
    c.col(1) = slope.col(k);
    c.col(2) = (3. * chord - 2. * slope.col(k) - slope.col(k + 1)) / h;
    c.col(3) = (slope.col(k) + slope.col(k + 1) - 2. * chord) / (h * h);
    addPiece(s[std::size_t(k)], s[std::size_t(k) + 1], c, k == 0 && corner);
  }
}

}  // namespace kinegraph
