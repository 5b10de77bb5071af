#pragma once

#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A curve y(s) of cubic pieces. Smooth sections follow each other; between two sections the direction may jump, at a
/// *corner*.
struct CubicPieces {
  std::vector<double> begin;          ///< (m,): s at the start of each piece, ascending
  std::vector<MatrixXd> coefficient;  ///< per piece (d, 4): of 1, (s - begin), (s - begin)^2, (s - begin)^3
  std::vector<char> is_corner;        ///< per piece: a corner is at its start
  double length = 0.;                 ///< s at the end

  int pieces() const { return int(begin.size()); }
  double end(int piece) const { return piece + 1 < pieces() ? begin[std::size_t(piece) + 1] : length; }

  /// The piece at s; at a knot, the later one.
  int pieceAt(double s) const;

  /// y, or a derivative of it, at s by the polynomial of a piece.
  VectorXd eval(int piece, double s, int order = 0) const;
  VectorXd eval(double s, int order = 0) const { return eval(pieceAt(s), s, order); }

  /// The least and the largest value of each row of y on a piece.
  struct Range {
    VectorXd least, largest;  ///< (d,)
  };
  Range range(int piece) const;

  /// Appends a smooth section: the cubic spline with continuous second derivatives and not-a-knot ends through the
  /// columns of y (d, K) at s (K,). Three columns give a parabola, two a line. `corner`: one is at its start.
  void addSpline(const std::vector<double>& s, const MatrixXd& y, bool corner);

  /// Appends Hermite pieces, with derivatives (d, K).
  void addHermite(const std::vector<double>& s, const MatrixXd& y, const MatrixXd& slope, bool corner);

 private:
  void addPiece(double from, double to, const MatrixXd& coefficients, bool is_corner);
};

}  // namespace kinegraph
