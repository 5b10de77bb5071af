#pragma once

#include <limits>

#include "kinegraph/solvers/algebra/constraint_curvature.h"
#include "kinegraph/solvers/algebra/indefinite.h"
#include "kinegraph/solvers/algebra/quadratic_program.h"
#include "kinegraph/solvers/algebra/quasi_newton.h"
#include "kinegraph/solvers/methods/sequential_quadratic.h"
#include "kinegraph/solvers/problems/constrained_function.h"

namespace kinegraph::inline solvers_internal {

/// The implementation of solveSequentialQuadratic. known_curvature.cpp handles problems with a known Hessian of the
/// costs.
class SequentialQuadratic {
 public:
  SequentialQuadratic(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback);

  SolverResult run(const VectorXd& dual);

 private:
  /// A step that solves a quadratic program, with its predictions.
  struct Step {
    VectorXd d, lambda, linear;  ///< linear: constraints after the step, to first order
    double relaxed = 0.;         ///< remaining share of the violation; 0 if the linearized constraints are consistent
    bool found = false;
    std::vector<int> active;  ///< constraints of the program with a multiplier
  };

  void iterate();
  void linearize(double scale);
  void addSquaredRows(MatrixXd& H) const;
  QuadraticProgram makeModel(const VectorXd& c) const;
  Step findStep();
  Step solveQuadratic(const VectorXd& c);
  bool lineSearch(const Step& step);
  void updateCurvature(const EvaluatedPoint& before, const EvaluatedPoint& after);
  bool fulfillsFirstOrder(const VectorXd& multipliers, double scale);
  double slopeInUnits(const VectorXd& multipliers);
  bool restartsCurvatureInUnits();

  // For a known Hessian of the costs.
  bool solvedInOneStep();
  void findHessian(const VectorXd& multipliers);
  void makeConvex(QuadraticProgram& program);
  bool leadsDown(const Step& step) const;
  double curvatureAlong(const VectorXd& d) const;
  double leastCurvature();
  void leaveRadius(QuadraticProgram& program) const;
  void adaptRadius(const Step& step, double alpha, double ratio);
  bool escapesSaddle(const Step& step);
  Restriction restriction(const Step& step) const;
  void probeConstraints(const Step& step);
  bool descendsAlong(const VectorXd& direction, const Step& step);
  VectorXd onActiveRows(const VectorXd& c, const Step& step) const;

  /// Evaluates the end of a step and returns the merit function, infinite for numbers that are not finite.
  double tryStep(const VectorXd& d) {
    trial_.x = function_.clip(here_.x + d);
    evaluate(trial_);
    return trial_.finite ? merit(trial_) : std::numeric_limits<double>::infinity();
  }

  void stop(SolverStatus status, std::string message) {
    status_ = status;
    message_ = std::move(message);
    stopped_ = true;
  }

  void evaluate(EvaluatedPoint& point) {
    if (!function_.evaluate(point)) stop(SolverStatus::cancelled, "cancelled by the caller");
  }

  double broken(int j, double c) const { return j < equalities_ ? std::abs(c) : std::max(0., c); }

  double merit(const EvaluatedPoint& point) const {
    double sum = point.cost;
    for (int j = 0; j < weights_.size(); ++j) sum += weights_[j] * broken(j, point.c[j]);
    return sum;
  }

  Nlp& nlp_;
  const SolverOptions& options_;
  ConstrainedFunction function_;
  const std::vector<int>& constraints_;
  int equalities_;
  const VectorXd &lower_, &upper_;
  QuasiNewton curvature_;
  EvaluatedPoint here_, trial_;
  DualActiveSet workspace_, relaxed_workspace_;
  MatrixXd H_, A_;      ///< of the quadratic program; A with rows of length 1
  VectorXd row_scale_;  ///< inverse norms of these rows in J
  VectorXd lambda_, weights_, gradient_, old_gradient_;
  VectorXd unit_;           ///< scale of each variable: its magnitude, at least 1
  VectorXd learning_unit_;  ///< scale of the curvature estimate: ones, or unit_ at its last reset
  bool learns_in_units_ = false;
  double tolerance_;
  bool stopped_ = false;
  SolverStatus status_ = SolverStatus::stalled;
  std::string message_;
  int resets_ = 0;      ///< number of failed steps
  int tiny_steps_ = 0;  ///< tiny steps at points that violate the first-order conditions

  const bool knows_curvature_;
  ConstraintCurvature constraint_curvature_;
  MatrixXd W_;               ///< Hessian of the Lagrangian, as far as known
  std::vector<int> active_;  ///< constraints of the program that are expected to be active
  bool holds_tight_only_ = false;
  int saddles_ = 0;
  double radius_ = std::numeric_limits<double>::infinity();  ///< of steps, if the Hessian is known
};

}  // namespace kinegraph::inline solvers_internal
