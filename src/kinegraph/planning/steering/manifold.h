#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/residual.h"
#include "kinegraph/planning/steering/constraint_bounds.h"
#include "kinegraph/planning/steering/joint_space.h"
#include "kinegraph/planning/steering/motion_constraint.h"

namespace kinegraph::inline planning_internal {

/// The configurations at which constraints hold, every row to within a tolerance. Every thread has its own.
class Manifold {
 public:
  /// `space` must outlive it. Throws ValueError for types other than eq and ineq, and for features of several
  /// configurations.
  Manifold(const State& scene, const JointSpace& space, const std::vector<MotionConstraint>& constraints,
           double tolerance);

  bool isEmpty() const { return residuals_.empty(); }
  double tolerance() const { return tolerance_; }

  /// The violation of the most violated row at q, in its own (scaled) unit.
  double violation(const VectorXd& q);

  /// The feature of that row with its frames, for messages.
  std::string worst(const VectorXd& q);

  /// Projects q onto the manifold by damped Gauss-Newton steps within the limits. If it returns false, q is undefined.
  bool project(VectorXd& q);

  /// Whether the constraints hold continuously along an edge, and at configurations that deviate from it by at most
  /// `deviation` in every dof. Rows whose rates have no bound (`sampled`) are checked at samples only.
  ///
  /// Evaluates the constraints at samples `spacing` apart. Between two samples at a distance w, a row exceeds its chord
  /// by at most w^2 / 8 times the bound of its second derivative; if that is too much, the interval is halved.
  bool holdsAlong(const VectorXd& from, const VectorXd& to, double spacing, double deviation = 0.);

  /// The features whose rates have no bound, with their frames, for messages.
  std::vector<std::string> sampled() const;

  long evaluations = 0;  ///< configurations at which the constraints were evaluated

 private:
  struct Row {
    Residual residual;
    ObjectiveType type;
    std::string name;
    ConstraintBounds bounds;
    bool is_bounded;
  };
  /// The values of the rows at a time of an edge.
  struct Moment {
    double time;
    VectorXd values;
  };
  void evalRows(const VectorXd& q, JacobianRows* J);
  void measure(const VectorXd& q, bool with_jacobian);
  template <class Visit>
  void forRows(const Visit& visit);
  void boundRates(const VectorXd& from, const VectorXd& change, double deviation);
  Moment momentAt(const VectorXd& from, const VectorXd& change, double time);
  bool keep(const VectorXd& values, const VectorXd& slack) const;
  bool holdsBetween(const VectorXd& from, const VectorXd& change, const Moment& a, const Moment& b, int depth);

  const JointSpace* space_;
  double tolerance_;
  State state_;
  std::vector<Row> residuals_;
  std::vector<char> is_equality_;  ///< per row
  VectorXd y_;                     ///< violations: 0 where an inequality holds
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J_;
  DisplacementBound edge_;
  VectorXd curvature_, deviation_;  ///< per row, bounds on the present edge: second derivative; change by deviations
};

}  // namespace kinegraph::inline planning_internal
