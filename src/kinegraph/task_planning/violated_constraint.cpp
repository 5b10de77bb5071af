#include "kinegraph/task_planning/violated_constraint.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/explanation.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

std::string violatedConstraint(const std::shared_ptr<Komo>& komo, const CancellationToken& cancellation) {
  const VectorXd x = komo->path().variables();
  const Explanation explanation = explain(*makeNlp(komo), x, 1e-3, cancellation);
  if (explanation.conflicts.empty()) return "";
  const Conflict& worst = explanation.conflicts[std::size_t(std::max(explanation.best, 0))];
  if (!worst.details.empty()) return worst.details[0];
  const bool is_length = !std::isnan(worst.violation.meters);
  return cat(worst.name, " is missed by ", fixed(is_length ? worst.violation.meters : worst.violation.scaled, 3),
             is_length ? " m" : "");
}

}  // namespace kinegraph
