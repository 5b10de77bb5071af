#pragma once

#include <memory>

#include "kinegraph/solvers/interface/evaluation_hook.h"
#include "kinegraph/solvers/interface/options.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// What a solution of a problem requests memory for, and the next one of the same problem can use again.
class AugmentedLagrangianMemory {
 public:
  AugmentedLagrangianMemory();
  ~AugmentedLagrangianMemory();
  struct Parts;
  std::unique_ptr<Parts> parts;  ///< null until used
};

/// Minimizes the costs of `nlp` subject to its constraints and bounds, from `x0` (clipped to the bounds).
///
/// An augmented Lagrangian whose inner steps minimize a piecewise quadratic Gauss-Newton model in a box, with Levenberg
/// damping that is adapted to how well the model predicts. Multipliers are those of the model, updated when an inner
/// problem is nearly solved. A step that reduces neither cost nor violation ends it with the reason; where no step
/// reduces the linearized violation, the constraints are locally infeasible, and the least violation is sought. `dual`
/// (empty, or one multiplier per residual) starts it warm. Sources: Nocedal & Wright, Numerical Optimization, 2nd ed.,
/// ch. 17.4; Qi & Sun, A nonsmooth version of Newton's method, 1993; Nielsen, Damping parameter in Marquardt's method,
/// 1999. `memory`, where given, is of this problem alone.
SolverResult solveAugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                      const VectorXd& dual = {}, const EvaluationHook& hook = {},
                                      AugmentedLagrangianMemory* memory = nullptr);

}  // namespace kinegraph
