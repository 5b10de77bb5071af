#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/nlp/parameter.h"
#include "kinegraph/nlp/separation.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

class DoubledLimits;
class PolishedSolution;

struct SensitivityOptions {
  bool hold_weak = false;  ///< take constraints that touch without pressing as holding, not as not there
};

/// How a solution x of a problem moves with numbers p that the problem depends on: by the implicit function theorem on
/// the conditions of a solution, with the constraints that are active,
///
///     [ H  A^T ] [ dx/dp ]     [ d (gradient of the Lagrangian) / dp ]
///     [ A   0  ] [ dl/dp ] = - [ d (active residuals) / dp           ]
///
/// H has the second derivatives of costs and active constraints. The solution is brought to rounding first, so that the
/// tolerances of the solver do not matter.
///
/// Where constraints touch without pressing the solution has a kink, and dx/dp is that of one side: `weak()` names
/// them. A limit that was given twice, and whose twin presses, is none unless the two move apart. Where costs and
/// constraints leave directions free (redundant joints without a posture cost) it is the shortest dx/dp:
/// `freeDirections()` counts them.
/// Source: Fiacco, Introduction to Sensitivity and Stability Analysis in Nonlinear Programming, 1983.
class Sensitivity {
 public:
  /// At x with multipliers `dual` (one per residual, or empty). Leaves the problem at the exact solution. Throws Error
  /// if that is not found.
  Sensitivity(std::shared_ptr<Nlp> problem, const VectorXd& x, const VectorXd& dual, NlpParameters parameters,
              const SensitivityOptions& options = {});

  /// Of a result. Throws ValueError if it is not feasible, or not of a problem.
  Sensitivity(const SolverResult& result, NlpParameters parameters, const SensitivityOptions& options = {});
  ~Sensitivity();
  Sensitivity(Sensitivity&&) noexcept;
  Sensitivity& operator=(Sensitivity&&) noexcept;

  const VectorXd& x() const;     ///< the solution, to rounding
  const VectorXd& dual() const;  ///< multipliers of the problem's residuals
  int evals() const;             ///< that it took to get there

  const std::vector<std::string>& names() const { return names_; }  ///< of the parameters' numbers, one after the other
  int size() const { return int(names_.size()); }

  /// dx/dp, n x size().
  const MatrixXd& jacobian();

  /// (dx/dp)^T v for a function of x with gradient v: one solution of the linear system, whatever the size is.
  VectorXd gradient(const VectorXd& v);

  std::vector<std::string> active() const;  ///< inequalities and bounds that press
  std::vector<std::string> weak();          ///< that touch and do not press: the solution has a kink
  int freeDirections() const;               ///< about how many; dx/dp has no part in them
  bool isSaddle() const;                    ///< the costs do not grow in all directions that the constraints leave

  /// Is dx/dp the derivative, as it is where nothing touches without pressing and no direction is free? ...
  bool isRegular();
  std::string message();  ///< ... else why not, in words.

  /// Numbers that neither costs nor active constraints depend on: dx/dp is zero.
  std::vector<std::string> withoutEffect();

 private:
  void differentiate();
  std::string nameOfBound(int variable, bool is_upper) const;
  void note(double residual);

  std::shared_ptr<Nlp> problem_;
  Separation separation_;
  Nlp* nlp_;  ///< the separate form, if there is one
  NlpParameters parameters_;
  std::vector<std::string> names_;
  std::unique_ptr<PolishedSolution> solution_;
  std::unique_ptr<DoubledLimits> doubled_;
  VectorXd dual_;
  bool holds_weak_ = false, is_differentiated_ = false, has_jacobian_ = false, is_solvable_ = true;
  MatrixXd of_gradient_, of_rows_;  ///< derivatives of the conditions, a column per number
  std::vector<int> moved_bound_;    ///< per number: the fixed variable that it moves, or -1
  MatrixXd jacobian_;
};

}  // namespace kinegraph
