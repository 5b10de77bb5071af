#include "kinegraph/solvers/methods/augmented_lagrangian.h"

#include "kinegraph/solvers/methods/augmented_lagrangian_method.h"

namespace kinegraph {

AugmentedLagrangianMemory::AugmentedLagrangianMemory() = default;
AugmentedLagrangianMemory::~AugmentedLagrangianMemory() = default;

SolverResult solveAugmentedLagrangian(Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const VectorXd& dual,
                                      const EvaluationCallback& callback, AugmentedLagrangianMemory* memory) {
  AugmentedLagrangianMemory own;
  auto& parts = (memory ? memory : &own)->parts;
  if (!parts) parts = std::make_unique<AugmentedLagrangianMemory::Parts>(nlp);
  parts->function.begin(x0, options, callback);
  return AugmentedLagrangian(nlp, *parts, x0, options).run(dual);
}

}  // namespace kinegraph
