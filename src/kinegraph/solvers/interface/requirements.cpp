#include "kinegraph/solvers/interface/requirements.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline solvers_internal {

void requireStart(const Nlp& nlp, const VectorXd& x0) {
  if (x0.size() != nlp.dimension()) {
    throw ValueError(cat("the start has ", x0.size(), " entries; the problem has ", nlp.dimension(), " variables"));
  }
  if (!x0.allFinite()) throw ValueError("the start has entries that are not finite");
}

void requireNoConstraints(const Nlp& nlp, const char* method) {
  for (int row = 0; row < int(nlp.types().size()); ++row) {
    const ObjectiveType type = nlp.types()[row];
    if (type != ObjectiveType::eq && type != ObjectiveType::ineq && type != ObjectiveType::ineqB) continue;
    throw ValueError(cat("OptMethod::", method, " does not support constraints, such as ", nlp.rowName(row),
                         "; use augmentedLag, squaredPenalty, logBarrier or slackGN_logBarrier"));
  }
}

}  // namespace kinegraph::inline solvers_internal
