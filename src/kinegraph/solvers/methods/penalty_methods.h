#pragma once

#include "kinegraph/solvers/methods/augmented_lagrangian.h"

namespace kinegraph {

/// Constraints as squared penalties, whose weight grows from muInit by muInc until they hold to the tolerance or the
/// weight reaches muMax. `single`: one problem, with weight muInit. Without multipliers, so `dual` is zero.
SolverResult solveSquaredPenalty(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook,
                                 bool single);

/// Inequalities as barriers -mu log(-phi), whose weight falls from muLBInit by muLBDec; equalities by an augmented
/// Lagrangian. Throws ValueError if the start is not strictly inside of all inequalities.
SolverResult solveLogBarrier(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook);

/// Gauss-Newton on the violation of the constraints alone, until they hold; costs do not matter. Inequalities are
/// wanted below -interiorPadding.
SolverResult solveSlack(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationHook& hook);

}  // namespace kinegraph
