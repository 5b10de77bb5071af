#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/nlp/nlp.h"
#include "kinegraph/planning/steering/constraint_bounds.h"
#include "kinegraph/planning/steering/joint_space.h"

namespace kinegraph {

/// A condition on postures: scale * (feature - target) is zero (eq), or not positive (ineq).
struct MotionConstraint {
  FeatureSource feature;
  std::vector<std::string> frames;
  ObjectiveType type = ObjectiveType::eq;
  Scale scale = {};
  Target target = {};
};

/// The postures at which constraints hold, each row to within a tolerance. Every thread has its own.
class Manifold {
 public:
  /// `space` must stay. Throws ValueError for types other than eq and ineq, and for features of several configurations.
  Manifold(const State& scene, const JointSpace& space, const std::vector<MotionConstraint>& constraints,
           double tolerance);

  bool isEmpty() const { return residuals_.empty(); }
  double tolerance() const { return tolerance_; }

  /// By how much the worst row is violated at q, in its own (scaled) unit.
  double violation(const VectorXd& q);

  /// The feature of that row, with its frames.
  std::string worst(const VectorXd& q);

  /// Moves q to the manifold by damped Gauss-Newton steps within the limits. False, and q anywhere, if that fails.
  bool project(VectorXd& q);

  /// Do they hold along a straight motion, at all times, and at postures that differ from one of it by `stray` at most in
  /// every dof? Of rows whose rates have no bound (`sampled`), as far as postures of the motion tell.
  ///
  /// Postures every `spacing` are looked at. Between two of them, w apart, a row is above its chord by no more than w^2 / 8
  /// of the bound of its second derivative; where that is too much, the interval is halved.
  bool holdsAlong(const VectorXd& from, const VectorXd& to, double spacing, double stray = 0.);

  /// The features whose rates have no bound, with their frames.
  std::vector<std::string> sampled() const;

  long evaluations = 0;  ///< postures at which the constraints were computed

 private:
  struct Row {
    Residual residual;
    ObjectiveType type;
    std::string name;
    ConstraintBounds bounds;
    bool is_bounded;
  };
  /// A time of a motion, and the rows there.
  struct Moment {
    double time;
    VectorXd values;
  };
  void evalRows(const VectorXd& q, JacobianRows* J);
  void measure(const VectorXd& q, bool with_jacobian);
  template <class Visit>
  void forRows(const Visit& visit);
  void boundRates(const VectorXd& from, const VectorXd& change, double stray);
  Moment momentAt(const VectorXd& from, const VectorXd& change, double time);
  bool keep(const VectorXd& values, const VectorXd& room) const;
  bool holdsBetween(const VectorXd& from, const VectorXd& change, const Moment& a, const Moment& b, int depth);

  const JointSpace* space_;
  double tolerance_;
  State state_;
  std::vector<Row> residuals_;
  std::vector<char> is_equality_;  ///< per row
  VectorXd y_;                     ///< violations: 0 where an inequality holds
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J_;
  MotionBounds motion_;
  VectorXd bend_, stray_;  ///< per row, of the present motion: of its second derivative, and what straying may add
};

}  // namespace kinegraph
