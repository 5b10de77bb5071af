#pragma once

#include <optional>
#include <vector>

#include "kinegraph/nlp/parameter.h"
#include "kinegraph/solvers/sensitivity/polished_solution.h"

namespace kinegraph::inline solvers_internal {

/// Weakly active constraints that are redundant: strongly active ones already fix their variables. An example is a
/// limit that is both a bound and an objective. The solution stays smooth as long as both move alike.
class RedundantBounds {
 public:
  /// Removes the redundant constraints of a solution from its weakly active ones.
  explicit RedundantBounds(PolishedSolution& at);

  /// Handles a parameter that moves the residuals by dphi, and possibly a bound. Redundant constraints that then
  /// separate from the strongly active ones become weakly active again.
  void move(PolishedSolution& at, const Nlp& nlp, const VectorXd& dphi,
            const std::optional<NlpParameter::Bound>& bound);

 private:
  double motionOf(const PolishedSolution& at, int variable, const VectorXd& dphi) const;

  std::vector<int> rows_, lower_, upper_;
  std::vector<char> is_held_;  ///< per variable: whether a strongly active bound fixes it
  std::vector<int> pin_;       ///< per variable: the strongly active residual that fixes it, or -1
  int moved_ = -1;             ///< variable whose bound moves by one
};

}  // namespace kinegraph::inline solvers_internal
