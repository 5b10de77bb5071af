#include "kinegraph/scene/tree/joint_limits.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/text.h"

namespace kinegraph::inline scene_internal {

std::string limitsError(std::span<const double> limits) {
  if (std::any_of(limits.begin(), limits.end(), [](double limit) { return std::isnan(limit); }))
    return "a limit is nan; write -inf or inf for a missing limit";
  const std::size_t dofs = limits.size() / 2;
  std::size_t crossed = dofs;
  bool all_equal = true, in_turn = dofs > 1, a_range = false;
  for (std::size_t i = 0; i < dofs; ++i) {
    if (crossed == dofs && limits[i] > limits[dofs + i]) crossed = i;
    all_equal &= limits[i] == limits[dofs + i];
    in_turn &= limits[2 * i] <= limits[2 * i + 1];
    a_range |= limits[2 * i] < limits[2 * i + 1];
  }
  if (crossed == dofs && !(all_equal && in_turn && a_range)) return "";
  if (dofs == 1)
    return cat("the lower limit ", limits[0], " is above the upper limit ", limits[1], "; expected [lower, upper]: [",
               limits[1], " ", limits[0], "]");
  std::string mistake = "each lower limit equals its upper limit";
  if (crossed < dofs)
    mistake = cat("a lower limit is above its upper limit: that of dof ", crossed, " is ", limits[crossed], ", and ",
                  limits[dofs + crossed]);
  mistake += "; all lower limits come first, then all upper ones";
  std::string lower, upper;
  for (std::size_t i = 0; i < dofs; ++i) {
    lower += cat(std::min(limits[i], limits[dofs + i]), " ");
    upper += cat(std::max(limits[i], limits[dofs + i]), i + 1 < dofs ? " " : "");
  }
  return cat(mistake, ": [", lower, upper, "] if only these are swapped");
}

std::optional<std::vector<double>> limitsInTurn(std::span<const double> limits, std::string& warning) {
  const std::size_t dofs = limits.size() / 2;
  if (dofs < 2 || limitsError(limits).empty()) return std::nullopt;
  std::vector<double> ordered(2 * dofs);
  for (std::size_t i = 0; i < dofs; ++i) {
    if (!(limits[2 * i] <= limits[2 * i + 1])) return std::nullopt;
    ordered[i] = limits[2 * i];
    ordered[dofs + i] = limits[2 * i + 1];
  }
  std::string current;
  for (double limit : ordered) current += cat(current.empty() ? "" : " ", limit);
  warning =
      cat("limits are read as the lower and upper limit of each dof in turn; all lower limits come first, then "
          "all upper ones: [",
          current, "]");
  return ordered;
}

bool moveToEqualLimits(std::span<const MotionStep> steps, std::span<const double> limits, std::span<double> q) {
  if (std::ranges::any_of(steps, [](const MotionStep& step) { return step.orients(); })) return false;
  bool moved = false;
  for (std::size_t i = 0; i < limits.size() / 2; ++i) {
    if (limits[i] != limits[q.size() + i] || q[i] == limits[i]) continue;
    q[i] = limits[i];
    moved = true;
  }
  return moved;
}

}  // namespace kinegraph::inline scene_internal
