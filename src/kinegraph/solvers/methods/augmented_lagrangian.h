#pragma once

#include <memory>

#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// The memory and state of a solve, which further solves of the same problem reuse.
class AugmentedLagrangianMemory {
 public:
  AugmentedLagrangianMemory();
  ~AugmentedLagrangianMemory();
  struct Parts;
  std::unique_ptr<Parts> parts;  ///< null until used
};

/// Minimizes the costs of `nlp` subject to its constraints and bounds, from `x0` (clipped to the bounds).
///
/// Inner steps of the augmented Lagrangian method minimize a piecewise quadratic Gauss-Newton model in a box. Levenberg
/// damping adapts to the accuracy of the model. The multipliers are those of the model, updated when an inner problem
/// is nearly solved. If no step reduces cost or violation, the solve ends with the reason. If no step reduces the
/// linearized violation, the constraints are locally infeasible, and the method minimizes the violation. `dual` (empty,
/// or one multiplier per residual) is a warm start. Sources: Nocedal & Wright, Numerical Optimization, 2nd ed.,
/// ch. 17.4; Qi & Sun, A nonsmooth version of Newton's method, 1993; Nielsen, Damping parameter in Marquardt's method,
/// 1999. `memory` must belong to this problem.
SolverResult solveAugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const VectorXd& dual = {}, const EvaluationCallback& callback = {},
                                      AugmentedLagrangianMemory* memory = nullptr);

}  // namespace kinegraph
