#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinegraph::inline trajectories_internal {

/// low <= u x + w y + t <= high.
struct PlaneRow {
  double u, w, t, low, high;
};

/// A linear program in two variables: many rows |u x + w y + t| <= 1, further rows with their own limits, and a box.
class TwoVariableProgram {
 public:
  Eigen::ArrayXd u, w, t;        ///< of the rows with the limit 1
  std::vector<PlaneRow> others;  ///< rows with their own limits
  double x_low = 0., x_high = 0., y_low = 0., y_high = 0.;

  struct Answer {
    bool is_feasible = false;
    double x = 0., y = 0.;
    int rows[2] = {0, 0};              ///< the inequalities active at the solution, see signedValue
    double multipliers[2] = {0., 0.};  ///< of both, >= 0; if infeasible, those of the contradiction
    int third = -1;                    ///< if infeasible: the inequality that contradicts these two,
    double contradiction = 0.;         ///< and the violation
  };

  /// Maximizes dx x + dy y, with dx and dy of the same sign and not 0, by the dual simplex method: each pivot adds the
  /// inequality with the largest violation. Starts from the rows of `guess` if they are optimal alone, else from a
  /// corner of the box.
  Answer farthest(double dx, double dy, const Answer* guess = nullptr);

  /// Returns the value of the row of an inequality n (x, y) <= c, from one value per row, with the sign of the row in
  /// n.
  double signedValue(int inequality, const Eigen::ArrayXd& of_rows, const std::vector<double>& of_others) const;

 private:
  struct Cut {
    double a, b, c;
  };
  Cut cut(int inequality) const;
  int mostViolated(double x, double y, double tolerance);

  Eigen::ArrayXd value_;
};

}  // namespace kinegraph::inline trajectories_internal
