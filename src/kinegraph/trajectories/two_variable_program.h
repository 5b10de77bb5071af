#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinegraph {

/// low <= u x + w y + t <= high.
struct PlaneRow {
  double u, w, t, low, high;
};

/// A linear program in the plane: |u x + w y + t| <= 1 for many rows, and further rows with limits of their own within
/// a box.
class TwoVariableProgram {
 public:
  Eigen::ArrayXd u, w, t;        ///< of the rows with limit 1
  std::vector<PlaneRow> others;  ///< of any kind
  double x_low = 0., x_high = 0., y_low = 0., y_high = 0.;

  struct Answer {
    bool is_feasible = false;
    double x = 0., y = 0.;
    int rows[2] = {0, 0};              ///< where two rows meet; see `rowOffset`
    double multipliers[2] = {0., 0.};  ///< of both, >= 0; where there is no point, those of a contradiction
    int third = -1;                    ///< where there is no point: the row that contradicts these two,
    double contradiction = 0.;         ///< and by how much
  };

  /// The point that is farthest along (dx, dy), both of the same sign and none 0. From vertex to vertex of the rows that
  /// are missed by most (dual simplex), beginning where `guess` was if that is optimal for its two rows, or else at a
  /// corner of the box.
  Answer farthest(double dx, double dy, const Answer* guess = nullptr);

  /// Of the inequality numbered so, n (x, y) <= c: the given value per row (as `t`) with its sign in n.
  double signedValue(int inequality, const Eigen::ArrayXd& of_rows, const std::vector<double>& of_others) const;

 private:
  struct Cut {
    double a, b, c;
  };
  Cut cut(int inequality) const;
  int mostMissed(double x, double y, double tolerance);

  Eigen::ArrayXd value_;
};

}  // namespace kinegraph
