#include "kinegraph/task_planning/violated_constraint.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

namespace {

/// A length with three digits, small ones in mm.
std::string lengthText(double meters) {
  constexpr double kFew = 1e-3;  // m
  return meters < kFew ? cat(fixed(1e3 * meters, 2), " mm") : cat(fixed(meters, 3), " m");
}

}  // namespace

std::string violatedConstraint(const std::shared_ptr<Komo>& komo, const CancellationToken& cancellation) {
  const VectorXd x = komo->path().variables();
  const Explanation explanation = explain(*makeNlp(komo), x, 1e-3, cancellation);
  if (explanation.conflicts.empty()) return "";
  const Conflict& worst = explanation.conflicts[std::size_t(std::max(explanation.best, 0))];
  if (!worst.details.empty()) return worst.details[0];
  const bool is_length = !std::isnan(worst.violation.meters);
  const auto overlaps =
      std::ranges::find_if(explanation.conflicts, [](const Conflict& c) { return !c.details.empty(); });
  return cat(worst.name, " is missed by ",
             is_length ? lengthText(worst.violation.meters) : fixed(worst.violation.scaled, 4),
             overlaps == explanation.conflicts.end() ? "" : cat(" while ", overlaps->details[0]));
}

}  // namespace kinegraph::inline task_planning_internal
