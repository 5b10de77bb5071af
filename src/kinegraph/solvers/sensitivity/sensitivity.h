#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/nlp/parameter.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::inline solvers_internal {
class RedundantBounds;
class PolishedSolution;
}

namespace kinegraph {

struct SensitivityOptions {
  bool hold_weak = false;  ///< whether weakly active constraints count as active
};

/// The derivatives of a solution x with respect to parameters p of the problem. They follow from the implicit function
/// theorem on the optimality conditions with the active constraints:
///
///     [ H  A^T ] [ dx/dp ]     [ d (gradient of the Lagrangian) / dp ]
///     [ A   0  ] [ dl/dp ] = - [ d (active residuals) / dp           ]
///
/// H has the second derivatives of costs and active constraints. The solution is first refined to rounding errors, so
/// that the tolerances of the solver do not matter.
///
/// At weakly active constraints (active with multiplier zero) the solution is not differentiable, and dx/dp is a
/// one-sided derivative; `weak()` names these constraints. A redundant bound does not count as weakly active unless it
/// separates from its twin. If costs and constraints leave directions free (redundant joints without a posture cost),
/// dx/dp is the shortest one; `freeDirections()` counts these.
/// Source: Fiacco, Introduction to Sensitivity and Stability Analysis in Nonlinear Programming, 1983.
class Sensitivity {
 public:
  /// Refines the solution x with multipliers `dual` (one per residual, or empty). Leaves the problem at the refined
  /// solution. Throws Error if the refinement fails.
  Sensitivity(std::shared_ptr<Nlp> problem, const VectorXd& x, const VectorXd& dual, NlpParameters parameters,
              const SensitivityOptions& options = {});

  /// Refines a result. Throws ValueError if it is not feasible or has no problem.
  Sensitivity(const SolverResult& result, NlpParameters parameters, const SensitivityOptions& options = {});
  ~Sensitivity();
  Sensitivity(Sensitivity&&) noexcept;
  Sensitivity& operator=(Sensitivity&&) noexcept;

  const VectorXd& x() const;     ///< the refined solution
  const VectorXd& dual() const;  ///< multipliers of the problem's residuals
  int evals() const;             ///< of the refinement

  const std::vector<std::string>& names() const { return names_; }  ///< of all components of the parameters
  int size() const { return int(names_.size()); }

  /// dx/dp, n x size().
  const MatrixXd& jacobian();

  /// Returns (dx/dp)^T v for a function of x with gradient v. Solves one linear system for any number of parameters.
  VectorXd gradient(const VectorXd& v);

  std::vector<std::string> active() const;  ///< active inequalities and bounds
  std::vector<std::string> weak();          ///< weakly active ones, at which the solution is not differentiable
  int freeDirections() const;               ///< estimated number; dx/dp is orthogonal to them
  bool isSaddle() const;                    ///< the costs decrease in a feasible direction

  /// Whether dx/dp is the unique derivative: no constraint is weakly active and no direction is free.
  bool isRegular();
  std::string message();  ///< the reason why not; "" if it is

  /// Returns the parameters that neither costs nor active constraints depend on, so that dx/dp is zero.
  std::vector<std::string> withoutEffect();

 private:
  void differentiate();
  std::string nameOfBound(int variable, bool is_upper) const;
  void checkResidual(double residual);

  std::shared_ptr<Nlp> problem_;
  Separation separation_;
  Nlp* nlp_;  ///< the separate form, if any, else problem_
  NlpParameters parameters_;
  std::vector<std::string> names_;
  std::unique_ptr<PolishedSolution> solution_;
  std::unique_ptr<RedundantBounds> redundant_;
  VectorXd dual_;
  bool holds_weak_ = false, is_differentiated_ = false, has_jacobian_ = false, is_solvable_ = true;
  MatrixXd of_gradient_, of_rows_;  ///< derivatives of the conditions, one column per parameter
  std::vector<int> moved_bound_;    ///< per parameter: the fixed variable that it moves, or -1
  MatrixXd jacobian_;
};

}  // namespace kinegraph
