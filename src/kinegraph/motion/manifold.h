#pragma once

#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/motion/joint_space.h"
#include "kinegraph/nlp/nlp.h"

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

  /// Do they hold along a straight motion, as far as postures every `spacing` tell?
  bool holdsAlong(const VectorXd& from, const VectorXd& to, double spacing);

  long evaluations = 0;  ///< postures at which the constraints were computed

 private:
  struct Row {
    Residual residual;
    ObjectiveType type;
    std::string name;
  };
  void measure(const VectorXd& q, bool with_jacobian);

  const JointSpace* space_;
  double tolerance_;
  State state_;
  std::vector<Row> residuals_;
  VectorXd y_;  ///< violations: 0 where an inequality holds
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J_;
};

}  // namespace kinegraph
